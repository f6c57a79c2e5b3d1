// SPDX-License-Identifier: Apache-2.0
// Matrices of lanes (model/numerics/lanes.h) as arrays, and parts of them.
#pragma once

#include <cstddef>

#include "model/numerics/lanes.h"
#include "model/numerics/large_array.h"

namespace skyfit {

using Lanes = LargeArray;

// Element (i, j) of a matrix of lanes.
inline double* at(Lanes& m, std::size_t columns, std::size_t i, std::size_t j) {
  return m.data() + (i * columns + j) * lanes::kLanes;
}
inline const double* at(const Lanes& m, std::size_t columns, std::size_t i, std::size_t j) {
  return m.data() + (i * columns + j) * lanes::kLanes;
}

// Adds `sign` times `factor` (one element per row, or 1 when null) times rows x columns of `from`
// to `to`, from and to the given first columns.
void add_block(const double* factor, const Lanes& from, std::size_t from_columns,
               std::size_t from_first, Lanes& to, std::size_t to_columns, std::size_t to_first,
               std::size_t rows, std::size_t columns, double sign = 1);

// Adds a diagonal: one element per row, or 1 when null.
void add_diagonal(const double* diagonal, Lanes& to, std::size_t to_columns, std::size_t to_first,
                  std::size_t rows);

Lanes columns_of(const Lanes& m, std::size_t all, std::size_t first, std::size_t rows,
                 std::size_t count);

// Appends the first `count` numbers.
void append(Lanes& to, const Lanes& from, std::size_t count);

}  // namespace skyfit
