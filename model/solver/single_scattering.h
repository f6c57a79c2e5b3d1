// SPDX-License-Identifier: Apache-2.0
// Single scattering along one view ray, exact in spherical geometry, by Gauss's rule between fixed
// shells, the corners of the profiles, the edges of the planet's shadow and the ray's lowest point.
#pragma once

#include <array>
#include <vector>

#include "model/geometry/sky_geometry.h"

namespace skyfit {

// Columns of many points: those of air, aerosol and ozone, then their derivatives by scale height.
using ColumnArrays = std::array<std::vector<double>, 6>;

// The nodes of one ray, with what does not depend on the sun.
struct RayNodes {
  std::vector<RayPoint> points;
  std::vector<double> weight, height;          // metres
  std::array<std::vector<double>, 2> density;  // of air and aerosol
  ColumnArrays columns;                        // from the ray's entry
};
// `edges` are further places along the ray at which the rule begins anew.
RayNodes ray_nodes(const Shells& shells, const ViewRay& ray, const std::vector<double>& edges);

// The same nodes in the light of one sun.
struct SunlitNodes {
  std::vector<double> weight;  // 0 in the planet's shadow
  ColumnArrays columns;        // from the ray's entry to the node and on to the sun
};
SunlitNodes sunlit_nodes(const Shells& shells, const RayNodes& nodes, const SunAlongRay& sun);

// Radiance per unit solar irradiance without the phase functions (sr^0): multiply by P_i(nu) and
// add.
template <int N>
struct SingleScattering {
  Dual<N> air, aerosol;
};

template <int N>
SingleScattering<N> single_scattering(const Optics<N>& optics, const RayNodes& nodes,
                                      const SunlitNodes& sunlit);

}  // namespace skyfit
