// SPDX-License-Identifier: Apache-2.0
// Arrays with names in one file that NumPy reads: a zip archive of .npy files, numpy.load().
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace skyfit {

struct NamedArray {
  std::string name;  // letters, digits and _
  std::vector<std::size_t> shape;
  std::span<const double> values;  // C order: the last index is the fastest
};

// float64, deflated. The file appears whole or not at all; throws std::runtime_error that names it,
// and std::invalid_argument unless each array has as many values as its shape.
void write_npz(const std::filesystem::path& file, const std::vector<NamedArray>& arrays);

}  // namespace skyfit
