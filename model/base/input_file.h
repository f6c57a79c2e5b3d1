// SPDX-License-Identifier: Apache-2.0
// Reading files that others wrote. Only regular files are read, for a pipe or a device may never
// end, and only up to a size. Every refusal is one line, `file: cannot be read (reason), expected
// what`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace skyfit {

// Bytes. README.md states them.
inline constexpr std::uintmax_t kMostTextBytes = std::uintmax_t{256} << 20;  // JSON, CSV, MTL
inline constexpr std::uintmax_t kMostMeshBytes = std::uintmax_t{4} << 30;    // OBJ
inline constexpr std::uintmax_t kMostImageBytes = std::uintmax_t{16} << 30;  // images and maps

// For files that a library opens. Throws std::runtime_error.
void require_regular_file(const std::filesystem::path& file, std::string_view expectation,
                          std::uintmax_t most_bytes);

// The bytes of the file. Throws std::runtime_error.
std::string read_file(const std::filesystem::path& file, std::string_view expectation,
                      std::uintmax_t most_bytes = kMostTextBytes);

std::string_view without_byte_order_mark(std::string_view text);

// Text, without a byte order mark. Throws std::runtime_error.
std::string read_text_file(const std::filesystem::path& file, std::string_view expectation,
                           std::uintmax_t most_bytes = kMostTextBytes);

// The bytes of the standard input, to its end, which a user asked for. Throws std::runtime_error.
std::string read_stdin(std::string_view expectation, std::uintmax_t most_bytes = kMostTextBytes);

// Which files a data file may name.
enum class NamedFiles { kInItsFolder, kAnywhere };

// The file that a data file in `folder` names. Nothing where the name is empty or has a character
// of code 0, and, unless the file may lie anywhere, where it is absolute, has a part "..", or leads
// out of the folder by a symbolic link. A message then expects kNamedFile.
inline constexpr std::string_view kNamedFile =
    "a file in the folder of the one that names it, or --allow-paths";
std::optional<std::filesystem::path> named_file(const std::filesystem::path& folder,
                                                std::string_view name, NamedFiles allowed);

}  // namespace skyfit
