// SPDX-License-Identifier: Apache-2.0
#include "model/kernels.h"

// Sanitizers instrument the functions that choose a clone before they can run.
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
#define SKYFIT_CLONES \
  __attribute__((target_clones("arch=skylake-avx512", "arch=haswell", "default")))
#else
#define SKYFIT_CLONES
#endif

namespace skyfit::kernels {

SKYFIT_CLONES
void multiply(const double* __restrict a, const double* __restrict b, double* __restrict c,
              std::size_t rows, std::size_t inner, std::size_t columns) {
  constexpr std::size_t kRows = 4, kColumns = 16;  // a block of C that stays in registers
  for (std::size_t j = 0; j < columns; j += kColumns) {
    const std::size_t width = columns - j < kColumns ? columns - j : kColumns;
    for (std::size_t i = 0; i < rows; i += kRows) {
      const std::size_t height = rows - i < kRows ? rows - i : kRows;
      double sum[kRows][kColumns] = {};
      if (width == kColumns && height == kRows) {
        for (std::size_t k = 0; k < inner; ++k) {
          const double* __restrict row = b + k * columns + j;
          for (std::size_t x = 0; x < kRows; ++x) {
            const double factor = a[(i + x) * inner + k];
            for (std::size_t y = 0; y < kColumns; ++y) sum[x][y] += factor * row[y];
          }
        }
      } else {
        for (std::size_t k = 0; k < inner; ++k) {
          for (std::size_t x = 0; x < height; ++x) {
            for (std::size_t y = 0; y < width; ++y)
              sum[x][y] += a[(i + x) * inner + k] * b[k * columns + j + y];
          }
        }
      }
      for (std::size_t x = 0; x < height; ++x) {
        for (std::size_t y = 0; y < width; ++y) c[(i + x) * columns + j + y] = sum[x][y];
      }
    }
  }
}

SKYFIT_CLONES
void butterfly(double* __restrict x, double* __restrict y, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const double sum = x[i] + y[i];
    y[i] = x[i] - y[i];
    x[i] = sum;
  }
}

SKYFIT_CLONES
void blend(double t, const double* __restrict in, double a, const double* __restrict near, double b,
           const double* __restrict far, double* __restrict out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] = t * in[i] + a * near[i] + b * far[i];
}

SKYFIT_CLONES
void add_blend(double t, const double* __restrict in, double a, const double* __restrict near,
               double b, const double* __restrict far, double* __restrict out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] += t * in[i] + a * near[i] + b * far[i];
}

SKYFIT_CLONES
void add_scaled(double x, const double* __restrict in, double* __restrict out, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) out[i] += x * in[i];
}

}  // namespace skyfit::kernels
