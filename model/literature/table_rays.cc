// SPDX-License-Identifier: Apache-2.0
#include "model/literature/table_rays.h"

#include <algorithm>

#include "model/geometry/sun_disc.h"
#include "model/shared/shared.h"

namespace skyfit::literature {

std::vector<RayNode> ray_nodes(const Shells& shells, const ViewRay& ray) {
  constexpr int kShells = 6, kNodes = 3;
  if (ray.length <= 0) return {};
  std::vector<double> heights;
  for (int i = 1; i < kShells; ++i) {
    const double x = i / static_cast<double>(kShells);
    heights.push_back(shells.top * x * x * x);
  }
  std::vector<double> breaks =
      with_profile_breaks(shells, ray, shell_crossings(ray, shells.bottom_radius, heights));
  // Along the horizon in haze, all light comes from a small part of the way to the first shell.
  constexpr double kLow = 0.1, kLongPiece = 2e3;  // of the top; m
  if (ray.entry_height < kLow * shells.top && breaks.size() > 1 &&
      breaks[1] - breaks[0] > kLongPiece)
    breaks = with_piece_breaks(breaks);
  std::vector<RayNode> nodes;
  for (const QuadratureNode& q : composite_gauss(breaks, kNodes)) {
    const RayPoint at = ray_point(ray, shells.bottom_radius, q.s);
    nodes.push_back({q.s, q.weight, at.height, at.mu, columns_along(shells, ray, at)});
  }
  return nodes;
}

ViewRay table_ray(const Shells& shells, double height, double mu, bool ground) {
  Shared<double> shared;
  ViewRay ray;
  ray.entry_height = height;
  ray.entry_mu = mu;
  ray.hits_ground = ground;
  if (ground) {
    ray.length = ray.tangent_s =
        shared.distance_to_inner_sphere(shells.bottom_radius, height, mu, 0.0);
    return ray;
  }
  ray.length = shared.distance_to_outer_sphere(shells.bottom_radius, height, mu, shells.top);
  ray.tangent_s = std::min(std::max(-(shells.bottom_radius + height) * mu, 0.0), ray.length);
  ray.tangent_height =
      std::max(shared.height_after(shells.bottom_radius, height, mu, ray.tangent_s), 0.0);
  return ray;
}

SunLight sun_light(const Shells& shells, double height, double mu_s) {
  const double visible = visible_sun(shells.bottom_radius, height, mu_s, shells.sun_radius);
  if (visible <= 0) return {};
  return {visible, shells.columns_to_top(
                       height, std::max(mu_s, horizon_cosine(shells.bottom_radius, height)))};
}

}  // namespace skyfit::literature
