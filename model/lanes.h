// SPDX-License-Identifier: Apache-2.0
// Linear algebra on eight problems of one size at a time: element (i, j) of an r x c matrix is the
// kLanes doubles that begin at (i * c + j) * kLanes, one per problem. Compiled for several
// instruction sets, the best of which is chosen when the program is loaded. No aliasing of outputs
// with inputs unless stated.
#pragma once

#include <cstddef>

namespace skyfit::lanes {

inline constexpr std::size_t kLanes = 8;

// C = A B (+ D when D is not null): A rows x inner, B inner x columns, C and D rows x columns.
void multiply(const double* a, const double* b, const double* d, double* c, std::size_t rows,
              std::size_t inner, std::size_t columns);

// B = A^-1 B by elimination without pivoting, for diagonally dominant A (n x n), which is spent.
void solve(double* a, double* b, std::size_t n, std::size_t columns);

// (x, y) -> (x + y, x - y) for `count` elements.
void butterfly(double* x, double* y, std::size_t count);

// out = near q_near + far q_far, row by row: near and far have one element per row.
void layer_source(const double* near, const double* q_near, const double* far, const double* q_far,
                  double* out, std::size_t rows, std::size_t columns);

// out[r][j][p] += dt[r][p] x[r][j] + dnear[r][p] q_near[r][j] + dfar[r][p] q_far[r][j]
void add_layer_tangent(const double* dt, const double* x, const double* dnear,
                       const double* q_near, const double* dfar, const double* q_far, double* out,
                       std::size_t rows, std::size_t suns, std::size_t parameters);

// out[l][j][p] = domega[l][p] m[l][j] + omega[l] lambda[l][j] dbeam[j][p]
void moment_tangent(const double* domega, const double* m, const double* omega,
                    const double* lambda, const double* dbeam, double* out, std::size_t rows,
                    std::size_t suns, std::size_t parameters);

// out[r][j] = d[r] x[r][j]
void scale_rows(const double* d, const double* x, double* out, std::size_t rows,
                std::size_t columns);

}  // namespace skyfit::lanes
