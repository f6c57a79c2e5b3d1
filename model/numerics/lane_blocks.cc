// SPDX-License-Identifier: Apache-2.0
#include "model/numerics/lane_blocks.h"

#include <algorithm>

namespace skyfit {

// Adds `factor` (one element per row, or 1 when null) times rows x columns of `from` to `to`.
void add_block(const double* factor, const Lanes& from, std::size_t from_columns,
               std::size_t from_first, Lanes& to, std::size_t to_columns, std::size_t to_first,
               std::size_t rows, std::size_t columns, double sign) {
  for (std::size_t i = 0; i < rows; ++i) {
    const double* x = at(from, from_columns, i, from_first);
    double* y = at(to, to_columns, i, to_first);
    for (std::size_t j = 0; j < columns; ++j) {
      for (std::size_t k = 0; k < lanes::kLanes; ++k, ++x, ++y)
        *y += sign * (factor ? factor[i * lanes::kLanes + k] : 1.0) * *x;
    }
  }
}

// Adds a diagonal: one element per row, or 1 when null.
void add_diagonal(const double* diagonal, Lanes& to, std::size_t to_columns, std::size_t to_first,
                  std::size_t rows) {
  for (std::size_t i = 0; i < rows; ++i) {
    double* y = at(to, to_columns, i, to_first + i);
    for (std::size_t k = 0; k < lanes::kLanes; ++k)
      y[k] += diagonal ? diagonal[i * lanes::kLanes + k] : 1.0;
  }
}

Lanes columns_of(const Lanes& m, std::size_t all, std::size_t first, std::size_t rows,
                 std::size_t count) {
  Lanes r(rows * count * lanes::kLanes);
  for (std::size_t i = 0; i < rows; ++i)
    std::copy_n(at(m, all, i, first), count * lanes::kLanes, at(r, count, i, 0));
  return r;
}

void append(Lanes& to, const Lanes& from, std::size_t count) {
  to.insert(to.end(), from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace skyfit
