// SPDX-License-Identifier: Apache-2.0
#include "model/tables/texel_rays.h"

#include <algorithm>
#include <cmath>

#include "model/shared/shared.h"

namespace skyfit {

TexelRay texel_ray(const Shells& shells, const RayTexels& texels, int row, double height,
                   double deck) {
  Shared<double> shared;
  const double v = (row + 0.5) / texels.rows();
  const bool hits_ground = row < texels.ground;
  const double least = std::min(0.1, 1e-6 * shells.top);
  const double h = hits_ground ? std::max(height, least) : std::min(height, shells.top - least);
  const double mu = shared.mu_from_texture(v, h, texels.ground, texels.sky, shells.bottom_radius,
                                           shells.top, deck);
  ViewRay ray;
  ray.entry_height = h;
  ray.entry_mu = mu;
  ray.hits_ground = hits_ground;
  const double bottom = shells.bottom_radius;
  ray.length = hits_ground ? shared.distance_to_inner_sphere(bottom, h, mu, 0.0)
                           : shared.distance_to_outer_sphere(bottom, h, mu, shells.top);
  ray.tangent_s = hits_ground ? ray.length : std::clamp(-(bottom + h) * mu, 0.0, ray.length);
  ray.tangent_height =
      hits_ground ? 0 : std::max(shared.height_after(bottom, h, mu, ray.tangent_s), 0.0);
  const double to_sun_point = shared.distance_to_sun_point(h, mu, hits_ground, bottom, shells.top);
  return {ray, ray_point(ray, bottom, to_sun_point)};
}

std::vector<TexelSun> texel_suns(const RayTexels& texels, double bottom_radius, double height) {
  Shared<double> shared;
  std::vector<TexelSun> suns;
  for (int azimuth = 0; azimuth < texels.azimuth; ++azimuth) {
    const double cosine = shared.cosine_from_azimuth_unit(azimuth / (texels.azimuth - 1.0));
    for (int sun = 0; sun < texels.mu_s; ++sun) {
      const double sun_height = shared.sun_from_unit(sun / (texels.mu_s - 1.0), kTableLowestSun);
      const double mu_s = shared.mu_s_from_sun_height(height, sun_height, bottom_radius);
      suns.push_back({mu_s, std::sqrt(1 - mu_s * mu_s) * cosine});
    }
  }
  return suns;
}

}  // namespace skyfit
