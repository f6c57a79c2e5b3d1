// SPDX-License-Identifier: Apache-2.0
// The hot loops of the scattering tables on plain arrays of floats, compiled for several
// instruction sets as those of model/numerics/kernels.h. A cell is one texel of a ray: a sun and an
// azimuth. Four wavelengths lie side by side; a series in the cosine c of the azimuth phi, sum_b
// cos(4 b phi) sum_p a_bp c^p, is laid out in blocks [wavelength][power] of 16, see
// model/tables/diffuse_source.h.
#pragma once

#include <array>
#include <cstddef>

namespace skyfit::kernels {

// out[i] = (1 - part) low[i] + part high[i]
void mix(const float* low, const float* high, float part, std::size_t count, float* out);

// out[sun][block][16] += factor times the mix of low and high, which have the first `own` of the
// blocks; one factor per wavelength.
void add_source(const float* low, const float* high, float part, const float* factor,
                std::size_t suns, std::size_t own, std::size_t blocks, float* out);

// The cubic through four suns of the grid, at even steps of the cosine.
struct SunStep {
  int first;
  std::array<float, 4> weight;
};

// What a node of a ray's quadrature adds to every cell.
struct TableNode {
  // Where the node is: its local sun is sun_factor mu_s + nu_factor nu.
  float sun_factor, nu_factor, mu;
  // Of the node's share of the ray, the part is lit that lies above the edge of the planet's
  // shadow, sun + horizon = 0; over the share, sun + horizon changes by step_nu nu + step.
  float horizon, step_nu, step;
  // Cosines of the local sun go from `lowest` to 1, in even steps.
  float lowest;
  const SunStep* sun_steps;
  std::size_t sun_step_count;
  const float* beam;  // [step][wavelength]: transmittance to the sun where it is up, linear in
                      // between
  std::size_t beam_count;
  const float* source;  // [sun][block][16]: of multiple scattering, weight included; null: none
  std::size_t blocks;
  const float* single;  // [kind][wavelength]: weights of the beam, by who scatters it
  std::size_t kinds;
};

// single[cell][kind][4] += weights * beam; multiple[cell][16] += source * (1, c, c^2, c^3), c the
// cosine of the local azimuth.
void add_node(const TableNode& node, const float* mu_s, const float* nu, std::size_t cells,
              float* single, float* multiple);

// docs/theory (9.8).
// The texels of a ray: logarithms of scale * (single of kind 0 + multiple / phase) and of scale *
// single of each other kind, at least `darkest` before the logarithm. out[kind]:
// [cell][wavelength].
void store_cells(const float* single, std::size_t kinds, const float* multiple, const float* phase,
                 std::size_t cells, float scale, float darkest, float* const* out);

}  // namespace skyfit::kernels
