// SPDX-License-Identifier: Apache-2.0
// A short name for contents, to tell whether something has changed: XXH3, 128 bit, the same on
// every machine. Not against forgery.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace skyfit {

class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(ContentHash&&) noexcept;
  void add(std::string_view bytes);
  // The content of a regular file, or of all of a folder with their names; of a path where nothing
  // is, nothing.
  void add_file(const std::filesystem::path& file);
  std::string text() const;  // 32 hexadecimal digits

 private:
  struct State;  // of the library
  std::unique_ptr<State> state_;
};

}  // namespace skyfit
