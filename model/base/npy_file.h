// SPDX-License-Identifier: Apache-2.0
// Arrays as files that NumPy reads.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace skyfit {

// float32 in C order (the last index is the fastest), format 1.0 of .npy. The file appears whole or
// not at all; throws std::runtime_error that names it, and std::invalid_argument unless there are
// as many values as the shape has.
void write_npy(const std::filesystem::path& file, const std::vector<std::size_t>& shape,
               std::span<const float> values);

// The bytes of such a file, of float64. Throws std::invalid_argument as write_npy().
std::string npy_bytes(const std::vector<std::size_t>& shape, std::span<const double> values);

}  // namespace skyfit
