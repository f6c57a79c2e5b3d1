// SPDX-License-Identifier: Apache-2.0
// The hot loops of the integration along view rays on plain arrays. They are compiled for several
// instruction sets; the one that the processor has is chosen when the program is loaded, so that
// one binary runs everywhere.
#pragma once

#include <cstddef>

namespace skyfit::kernels {

// C = A B, row major, no aliasing: A rows x inner, B inner x columns, C rows x columns.
void multiply(const double* a, const double* b, double* c, std::size_t rows, std::size_t inner,
              std::size_t columns);

// out[i] += x in[i]
void add_scaled(double x, const double* in, double* out, std::size_t count);

// For points k: out[k][p] += factor[k] sum_j weight[k][j] rows[index[k][j]][p], j = 0 .. 3.
void accumulate_suns(const double* rows, std::size_t slices, const int* index, const double* weight,
                     const double* factor, std::size_t points, double* out);

}  // namespace skyfit::kernels
