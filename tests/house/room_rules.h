// SPDX-License-Identifier: Apache-2.0
// The rules of the house: which room may include and link what. One table, read by the test over
// the real sources and by the test over a house that breaks every rule.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace skyfit::house {

struct RoomRule {
  std::string room;                // folder below the top, e.g. "render/plot"
  std::vector<std::string> rooms;  // rooms it may include besides itself
  std::vector<std::string>
      externals;  // first path component of foreign headers, or their prefix when it ends in *
  std::vector<std::string> libraries;  // prefixes of foreign CMake targets it may link
};

// The rules of this project.
std::span<const RoomRule> room_rules();

// Violations found in the sources below `top`, one line each: `file:line: includes "x", which room
// may not use`.
std::vector<std::string> include_violations(const std::filesystem::path& top,
                                            std::span<const RoomRule> rules);

// Violations in a list of lines `room target library`, one line each.
std::vector<std::string> link_violations(const std::filesystem::path& links,
                                         std::span<const RoomRule> rules);

// Source files that the include rules were applied to.
std::vector<std::filesystem::path> room_sources(const std::filesystem::path& top,
                                                const RoomRule& rule,
                                                std::span<const RoomRule> rules);

}  // namespace skyfit::house
