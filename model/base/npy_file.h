// SPDX-License-Identifier: Apache-2.0
// Arrays as files that NumPy reads.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit {

// float32 in C order (the last index is the fastest), format 1.0 of .npy. The file appears whole or
// not at all; throws std::runtime_error that names it, and std::invalid_argument unless there are
// as many values as the shape has.
void write_npy(const std::filesystem::path& file, const std::vector<std::size_t>& shape,
               std::span<const float> values);

// The same of values as bytes, little-endian: `type` is NumPy's name of them, "<f2", and `size` the
// bytes of one.
void write_npy_bytes(const std::filesystem::path& file, const std::vector<std::size_t>& shape,
                     std::string_view type, std::size_t size, std::span<const std::byte> values);

// The bytes of such a file.
std::string npy_bytes(const std::vector<std::size_t>& shape, std::string_view type,
                      std::size_t size, std::span<const std::byte> values);

}  // namespace skyfit
