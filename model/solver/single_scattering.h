// SPDX-License-Identifier: Apache-2.0
// Single scattering along one view ray, exact in spherical geometry, by Gauss's rule between fixed
// shells, the corners of the profiles, the edges of the planet's shadow and the ray's lowest point.
#pragma once

#include <vector>

#include "model/atmosphere/optics.h"
#include "model/geometry/sun_along_ray.h"

namespace skyfit {

// Columns of many points, of each profile of the shells: [0] the column, [1 + s] its derivatives by
// the profile's shape.
using ColumnArrays = std::vector<std::vector<std::vector<double>>>;

// The nodes of one ray, with what does not depend on the sun.
struct RayNodes {
  std::vector<RayPoint> points;
  std::vector<double> weight, height;  // metres
  // Per profile as ColumnArrays: the density and its derivatives by the shape; empty for profiles
  // that no scatterer has.
  ColumnArrays density;
  ColumnArrays columns;  // from the ray's entry
};
// `derivatives` false leaves out what is derived by shapes; `scattering` says per profile whether a
// scatterer has it.
// `edges` are further places along the ray at which the rule begins anew.
RayNodes ray_nodes(const Shells& shells, const std::vector<char>& scattering, const ViewRay& ray,
                   const std::vector<double>& edges, bool derivatives);

// The same nodes in the light of one sun.
struct SunlitNodes {
  std::vector<double> weight;  // times the sun's irradiance: 0 in the planet's shadow
  std::vector<double> nu;      // cosine of the scattering angle
  ColumnArrays columns;        // from the ray's entry to the node and on to the sun
};
SunlitNodes sunlit_nodes(const Shells& shells, const RayNodes& nodes, const SunAlongRay& sun);

// Radiance per unit solar irradiance of every scatterer without its phase function (sr^0): multiply
// by P_i(nu) and add. With the values of the phase functions at the nodes, per scatterer, the
// result holds them already: nu changes along a refracted ray.
template <int N>
using PhaseAtNodes = std::vector<std::vector<Dual<N>>>;
template <int N>
std::vector<Dual<N>> single_scattering(const Optics<N>& optics, const RayNodes& nodes,
                                       const SunlitNodes& sunlit,
                                       const PhaseAtNodes<N>& phase = {});

}  // namespace skyfit
