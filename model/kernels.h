// SPDX-License-Identifier: Apache-2.0
// The hot loops of the multiple-scattering solver on plain arrays. They are compiled for several
// instruction sets; the one that the processor has is chosen when the program is loaded, so that
// one binary runs everywhere.
#pragma once

#include <cstddef>

namespace skyfit::kernels {

// C = A B, row major, no aliasing: A rows x inner, B inner x columns, C rows x columns.
void multiply(const double* a, const double* b, double* c, std::size_t rows, std::size_t inner,
              std::size_t columns);

// (x, y) -> (x + y, x - y) element by element.
void butterfly(double* x, double* y, std::size_t count);

// out[i] = t in[i] + a near[i] + b far[i]
void blend(double t, const double* in, double a, const double* near, double b, const double* far,
           double* out, std::size_t count);

// out[i] += t in[i] + a near[i] + b far[i]
void add_blend(double t, const double* in, double a, const double* near, double b,
               const double* far, double* out, std::size_t count);

// out[i] += x in[i]
void add_scaled(double x, const double* in, double* out, std::size_t count);

}  // namespace skyfit::kernels
