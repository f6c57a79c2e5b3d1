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

// out = near q_near + far q_far, element by element.
void blend(const double* near, const double* q_near, const double* far, const double* q_far,
           double* out, std::size_t count);

// out[r][j] += near[r] q_near[r][j] + far[r] q_far[r][j]
void add_blend(const double* near, const double* q_near, const double* far, const double* q_far,
               double* out, std::size_t rows, std::size_t columns);

// How the light that a layer sends along its rays changes with the parameters [p], for suns [j]:
//   out[r][j][p] = g[r][j] depth[r][p] + g_near[r][j] sun_near[j][p] + g_far[r][j] sun_far[j][p]
//                  + beam_near[r][j] dq_near[r][j][p] + beam_far[r][j] dq_far[r][j][p],
//   g = slope_near q_near + slope_far q_far + near_slope j_near + far_slope j_far - t x,
//   g_near = near_slopes[1] q_near + far_slopes[1] q_far, and g_far with [2] alike.
struct LayerTangent {
  const double *t, *near_slope, *far_slope;          // [r]
  const double *x, *j_near, *j_far;                  // [r][j]: light that enters; its sources
  const double *beam_near, *beam_far;                // [r][j]
  const double *near_slopes[3], *far_slopes[3];      // [r][j], by x and the sun's two depths
  const double *q_near, *q_far;                      // [r][j]: sources per unit of the beam
  const double *dq_near, *dq_far;                    // [r][j][p]
  const double* depth;                               // [r][p]
  const double *sun_near, *sun_far;                  // [j][p]
};
void layer_tangent(const LayerTangent& in, double* out, std::size_t rows, std::size_t suns,
                   std::size_t parameters);

// out[l][j][p] = domega[l][p] m[l][j]
void outer(const double* domega, const double* m, double* out, std::size_t rows, std::size_t suns,
           std::size_t parameters);

// out[r][j] = d[r] x[r][j]
void scale_rows(const double* d, const double* x, double* out, std::size_t rows,
                std::size_t columns);

}  // namespace skyfit::lanes
