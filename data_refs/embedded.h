// SPDX-License-Identifier: Apache-2.0
// The data files of this folder, compiled in.
#pragma once

#include <span>
#include <string_view>

namespace skyfit::refs {

struct EmbeddedFile {
  std::string_view name;  // relative to this folder: "presets/mars.json"
  std::string_view text;
};
std::span<const EmbeddedFile> embedded_files();

// Throws std::out_of_range when no such file was compiled in.
std::string_view embedded_text(std::string_view name);

}  // namespace skyfit::refs
