// SPDX-License-Identifier: Apache-2.0
// The rays of a model's table: where they are integrated and the columns along them, for every
// wavelength and order of scattering.
#pragma once

#include <numbers>
#include <vector>

#include "model/geometry/ray.h"
#include "model/literature/evaluate.h"

namespace skyfit::literature {

// One node of the quadrature along a ray of a table.
struct RayNode {
  double s, weight;     // m: distance from the ray's beginning, and weight of the integral over s
  double height, mu;    // there; mu of the ray
  PathColumns columns;  // from the beginning
};

// Three nodes by Gauss's rule between every two of six shells that the ray crosses, and between
// the corners of tabulated profiles; along the horizon near the ground, of the pieces of
// with_piece_breaks(). Deviation: the sources take some 50 equal steps, which are longer than an
// aerosol's scale height.
std::vector<RayNode> ray_nodes(const Shells& shells, const ViewRay& ray);

// The ray from height h whose cosine is mu, inside the atmosphere; `ground`: that it ends there is
// known, whatever the rounding of mu at the horizon says.
ViewRay table_ray(const Shells& shells, double height, double mu, bool ground);

// Whether and how much of the sun's disc shines on a height, and through which columns.
struct SunLight {
  double visible = 0;  // share of the disc, 0 .. 1
  PathColumns columns;
};
SunLight sun_light(const Shells& shells, double height, double mu_s);

// Of a view ray that meets the ground.
template <int N>
Dual<N> transmittance_to_ground(const Shells& shells, const ClearAir<N>& air, const ViewRay& ray) {
  const RayPoint end = ray_point(ray, shells.bottom_radius, ray.length);
  return exp(-air.optical_depth(columns_along(shells, ray, end)));
}

// What the ground sends along a view ray that meets it, at the ray's beginning, 1/sr. `sky(mu_s)`
// is the irradiance of the ground by the sky, `through` the transmittance of the ray.
template <int N, class SkyIrradiance>
Dual<N> ground_light(const Shells& shells, const ClearAir<N>& air, const View& view,
                     const SkyIrradiance& sky, const Dual<N>& through) {
  const double bottom = shells.bottom_radius;
  const double mu_s =
      ((bottom + view.ray.entry_height) * view.mu_s + view.ray.length * view.nu) / bottom;
  Dual<N> irradiance = sky(mu_s);
  if (mu_s > 0) {
    const SunLight sun = sun_light(shells, 0, mu_s);
    irradiance += mu_s * sun.visible * exp(-air.optical_depth(sun.columns));
  }
  return air.ground_albedo * (1 / std::numbers::pi) * irradiance * through;
}
template <int N, class SkyIrradiance>
Dual<N> ground_light(const Shells& shells, const ClearAir<N>& air, const View& view,
                     const SkyIrradiance& sky) {
  return ground_light(shells, air, view, sky, transmittance_to_ground(shells, air, view.ray));
}

}  // namespace skyfit::literature
