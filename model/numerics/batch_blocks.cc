// SPDX-License-Identifier: Apache-2.0
#include "model/numerics/batch_blocks.h"

#include <algorithm>

namespace skyfit {

// Adds `factor` (one element per row, or 1 when null) times rows x columns of `from` to `to`.
void add_block(const double* factor, const Batch& from, std::size_t from_columns,
               std::size_t from_first, Batch& to, std::size_t to_columns, std::size_t to_first,
               std::size_t rows, std::size_t columns, double sign) {
  for (std::size_t i = 0; i < rows; ++i) {
    const double* x = at(from, from_columns, i, from_first);
    double* y = at(to, to_columns, i, to_first);
    for (std::size_t j = 0; j < columns; ++j) {
      for (std::size_t k = 0; k < batch::kBatchWidth; ++k, ++x, ++y)
        *y += sign * (factor ? factor[i * batch::kBatchWidth + k] : 1.0) * *x;
    }
  }
}

// Adds a diagonal: one element per row, or 1 when null.
void add_diagonal(const double* diagonal, Batch& to, std::size_t to_columns, std::size_t to_first,
                  std::size_t rows) {
  for (std::size_t i = 0; i < rows; ++i) {
    double* y = at(to, to_columns, i, to_first + i);
    for (std::size_t k = 0; k < batch::kBatchWidth; ++k)
      y[k] += diagonal ? diagonal[i * batch::kBatchWidth + k] : 1.0;
  }
}

Batch columns_of(const Batch& m, std::size_t all, std::size_t first, std::size_t rows,
                 std::size_t count) {
  Batch r(rows * count * batch::kBatchWidth);
  for (std::size_t i = 0; i < rows; ++i)
    std::copy_n(at(m, all, i, first), count * batch::kBatchWidth, at(r, count, i, 0));
  return r;
}

void append(Batch& to, const Batch& from, std::size_t count) {
  to.insert(to.end(), from.begin(), from.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace skyfit
