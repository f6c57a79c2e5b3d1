// SPDX-License-Identifier: Apache-2.0
#include "model/numerics/kernels.h"

#include "model/numerics/clones.h"

namespace skyfit::kernels {

SKYFIT_CLONES
void multiply(const double* __restrict a, const double* __restrict b, double* __restrict c,
              std::size_t rows, std::size_t inner, std::size_t columns) {
  constexpr std::size_t kRows = 6, kColumns = 8;  // a block of C that stays in registers
  typedef double Vector __attribute__((vector_size(kColumns * sizeof(double))));
  if (rows < kRows || columns < kColumns) {
    for (std::size_t i = 0; i < rows; ++i) {
      for (std::size_t j = 0; j < columns; ++j) c[i * columns + j] = 0;
      for (std::size_t k = 0; k < inner; ++k) {
        const double factor = a[i * inner + k];
        for (std::size_t j = 0; j < columns; ++j) c[i * columns + j] += factor * b[k * columns + j];
      }
    }
    return;
  }
  // The last blocks overlap the ones before and write the same numbers again.
  for (std::size_t column = 0; column < columns; column += kColumns) {
    const std::size_t j = column + kColumns <= columns ? column : columns - kColumns;
    for (std::size_t row = 0; row < rows; row += kRows) {
      const std::size_t i = row + kRows <= rows ? row : rows - kRows;
      Vector s0{}, s1{}, s2{}, s3{}, s4{}, s5{};
      const double* factor = a + i * inner;
      for (std::size_t k = 0; k < inner; ++k, ++factor) {
        Vector x;
        __builtin_memcpy(&x, b + k * columns + j, sizeof x);
        s0 += factor[0] * x;
        s1 += factor[inner] * x;
        s2 += factor[2 * inner] * x;
        s3 += factor[3 * inner] * x;
        s4 += factor[4 * inner] * x;
        s5 += factor[5 * inner] * x;
      }
      const Vector sums[kRows] = {s0, s1, s2, s3, s4, s5};
      for (std::size_t x = 0; x < kRows; ++x) {
        __builtin_memcpy(c + (i + x) * columns + j, &sums[x], sizeof sums[x]);
      }
    }
  }
}

SKYFIT_CLONES
void add_scaled(double x, const double* __restrict in, double* __restrict out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] += x * in[i];
}

SKYFIT_CLONES
void accumulate_suns(const double* __restrict rows, std::size_t slices, const int* __restrict index,
                     const double* __restrict weight, const double* __restrict factor,
                     std::size_t points, double* __restrict out) {
  for (std::size_t k = 0; k < points; ++k, index += 4, weight += 4, out += slices) {
    const double *a = rows + index[0] * slices, *b = rows + index[1] * slices,
                 *c = rows + index[2] * slices, *d = rows + index[3] * slices;
    const double wa = factor[k] * weight[0], wb = factor[k] * weight[1], wc = factor[k] * weight[2],
                 wd = factor[k] * weight[3];
    for (std::size_t p = 0; p < slices; ++p)
      out[p] += wa * a[p] + wb * b[p] + wc * c[p] + wd * d[p];
  }
}

}  // namespace skyfit::kernels
