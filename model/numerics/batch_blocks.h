// SPDX-License-Identifier: Apache-2.0
// Matrices of lanes (model/numerics/batch.h) as arrays, and parts of them.
#pragma once

#include <cstddef>

#include "model/numerics/batch.h"
#include "model/numerics/large_array.h"

namespace skyfit {

using Batch = LargeArray;

// Element (i, j) of a matrix of lanes.
inline double* at(Batch& m, std::size_t columns, std::size_t i, std::size_t j) {
  return m.data() + (i * columns + j) * batch::kBatchWidth;
}
inline const double* at(const Batch& m, std::size_t columns, std::size_t i, std::size_t j) {
  return m.data() + (i * columns + j) * batch::kBatchWidth;
}

// Adds `sign` times `factor` (one element per row, or 1 when null) times rows x columns of `from`
// to `to`, from and to the given first columns.
void add_block(const double* factor, const Batch& from, std::size_t from_columns,
               std::size_t from_first, Batch& to, std::size_t to_columns, std::size_t to_first,
               std::size_t rows, std::size_t columns, double sign = 1);

// Adds a diagonal: one element per row, or 1 when null.
void add_diagonal(const double* diagonal, Batch& to, std::size_t to_columns, std::size_t to_first,
                  std::size_t rows);

Batch columns_of(const Batch& m, std::size_t all, std::size_t first, std::size_t rows,
                 std::size_t count);

// Appends the first `count` numbers.
void append(Batch& to, const Batch& from, std::size_t count);

}  // namespace skyfit
