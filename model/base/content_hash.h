// SPDX-License-Identifier: Apache-2.0
// A short name for contents, to tell whether something has changed: FNV-1a, 64 bit, the same on
// every machine. Not against forgery.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace skyfit {

class ContentHash {
 public:
  void add(std::string_view bytes);
  // The content of a regular file, or of all of a folder with their names; of a path where nothing
  // is, nothing.
  void add_file(const std::filesystem::path& file);
  std::string text() const;  // 16 hexadecimal digits

 private:
  std::uint64_t state_ = 0xcbf29ce484222325u;
};

}  // namespace skyfit
