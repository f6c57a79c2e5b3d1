// SPDX-License-Identifier: Apache-2.0
// Linear algebra on eight problems of one size at a time: element (i, j) of an r x c matrix is the
// kBatchWidth doubles that begin at (i * c + j) * kBatchWidth, one per problem. Compiled for
// several instruction sets, the best of which is chosen when the program is loaded. No aliasing of
// outputs with inputs unless stated.
#pragma once

#include <cstddef>

namespace skyfit::batch {

inline constexpr std::size_t kBatchWidth = 8;

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

// out[i] += a x[i] with one element a for all.
void add_scaled(const double* a, const double* x, double* out, std::size_t count);

// out[r][j] += near[r] q_near[r][j] + far[r] q_far[r][j]
void add_blend(const double* near, const double* q_near, const double* far, const double* q_far,
               double* out, std::size_t rows, std::size_t columns);

// How the light that a layer sends along its rays changes with the parameters [p], for suns [j]. Of
// one end of the layer, near or far:
struct ScattererTangent {
  const double* share;           // [1]: of the extinction, source per unit of each below
  const double* share_tangent;   // [p]
  const double *diffuse, *beam;  // [r][j]
};
inline constexpr std::size_t kMostScatterers = 8;
struct LayerEndTangent {
  const double* slope;           // [r]: d weight / d depth, of the diffuse source
  const double* weight;          // [r]: of the diffuse source
  const double* beam;            // [r][j]: weight of the beam's source
  const double* beam_slopes[3];  // [r][j]: by depth and the sun's depths at the near and far end
  ScattererTangent scatterer[kMostScatterers];
};
// out[r][j][p] = g[r][j] depth[r][p] + g_near[r][j] sun_near[j][p] + g_far[r][j] sun_far[j][p]
//                + sum over ends and scatterers of (weight diffuse + beam beam_source)
//                share_tangent[p],
// with g = sum over ends of (slope diffuse + beam_slopes[0] beam) - t x, diffuse and beam summed
// over scatterers by their shares, x the light that enters, and g_near, g_far those with
// beam_slopes[1] and [2].
struct LayerTangent {
  LayerEndTangent end[2];
  std::size_t scatterers;
  const double *t, *x;               // [r], [r][j]
  const double* depth;               // [r][p]
  const double *sun_near, *sun_far;  // [j][p]
};
void layer_tangent(const LayerTangent& in, double* out, std::size_t rows, std::size_t suns,
                   std::size_t parameters);

// out[r][j][p] += sum over ends of share (weight[r] diffuse[r][j] + beam[r][j] beam_source[r][j])
struct PhaseTangent {
  const double *share, *weight, *diffuse, *beam, *beam_source;
};
void add_phase_tangent(const PhaseTangent end[2], double* out, std::size_t rows, std::size_t suns,
                       std::size_t parameters, std::size_t p);

// out[r][j] = d[r] x[r][j]
void scale_rows(const double* d, const double* x, double* out, std::size_t rows,
                std::size_t columns);

}  // namespace skyfit::batch
