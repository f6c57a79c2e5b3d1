// SPDX-License-Identifier: Apache-2.0
// Grids of frames in which quantities vary along columns and rows. A strip is a grid of one row.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "render/render.h"

namespace skyfit {

// What varies along an axis, with its value at each step.
struct GridQuantity {
  std::string name, caption;        // "altitude-m", in captions "altitude"
  std::string unit;                 // "1/m", "1" of a pure number; empty for words
  std::vector<std::string> values;  // numbers in that unit, or words
};

// Columns or rows: quantities of as many values each, which move together. Without one the axis has
// one step.
using GridAxis = std::vector<GridQuantity>;
std::size_t steps_of(const GridAxis& axis);

enum class Spacing { kEven, kGeometric };

// `count` >= 2 values from `first` to `last`, both included, with the same difference or the same
// factor between neighbours; of 9 digits, as they are printed. Throws std::invalid_argument for
// geometric steps unless both ends are above 0 or both below.
std::vector<double> spaced(double first, double last, int count, Spacing spacing);

// "mie.scattering [1/m]: 1e-06, 2e-06; altitude-m [m]: 2000, 5000", for the metadata of a picture.
std::string described(const GridAxis& axis);

// What stands below a frame: the quantities of both axes with their values there, numbers with
// 4 digits.
std::vector<Caption> captions_at(const GridAxis& columns, std::size_t column, const GridAxis& rows,
                                 std::size_t row);

}  // namespace skyfit
