// SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>

#include "model/geometry/sun_disc.h"
#include "model/literature/bruneton_tables.h"
#include "model/literature/slab_kernels.h"
#include "model/shared/shared.h"

namespace skyfit::literature {
namespace {

using Sizes = BrunetonSizes;
constexpr int kHalf = Sizes::mu / 2;
constexpr int kSunPositions = 1 << 14;  // a texel of the 32 is hundreds of them

static_assert(Sizes::mu_s == SlabShape::suns && Sizes::nu == SlabShape::angles);

double nu_of(int i, double mu, double mu_s) {
  const double nu = Shared<double>{}.bruneton_nu_from_unit(unit_of(i, Sizes::nu));
  const double reach = std::sqrt(std::max((1 - mu * mu) * (1 - mu_s * mu_s), 0.0));
  return std::clamp(nu, mu * mu_s - reach, mu * mu_s + reach);
}

double evenly_spaced_cosine(int i) { return 2.0 * i / (kSunPositions - 1.0) - 1.0; }

}  // namespace

BrunetonGeometry::BrunetonGeometry(const Atmosphere<double>& atmosphere)
    : shells_(shells_of(atmosphere, Keep::kAll)),
      rays_(static_cast<std::size_t>(Sizes::r) * Sizes::mu),
      sun_position_(kSunPositions) {
  Shared<double> shared;
  for (int i = 0; i < Sizes::mu_s; ++i) {
    suns_.push_back(shared.bruneton_sun_from_unit(unit_of(i, Sizes::mu_s), kTableLowestSun,
                                                  bottom(), thickness()));
  }
  for (int i = 0; i < kSunPositions; ++i) {
    const double mu_s = std::max(evenly_spaced_cosine(i), kTableLowestSun);
    sun_position_[static_cast<std::size_t>(i)] = static_cast<float>(
        shared.bruneton_unit_from_sun(mu_s, kTableLowestSun, bottom(), thickness()) *
        (Sizes::mu_s - 1));
  }
  tbb::parallel_for(0, Sizes::r, [&](int r) {
    const double height = std::min(
        shared.bruneton_height_from_unit(unit_of(r, Sizes::r), bottom(), thickness()), thickness());
    for (int i = 0; i < Sizes::mu; ++i) {
      const bool ground = i < kHalf;
      const double unit = unit_of(ground ? i : i - kHalf, kHalf);
      const double mu = ground ? shared.mu_from_ground_unit(unit, height, bottom())
                               : shared.mu_from_upward_unit(unit, height, bottom(), thickness());
      Ray& ray = rays_[static_cast<std::size_t>(r * Sizes::mu + i)];
      ray = {height, mu, ground, {}, {}};
      for (int k = 0; k < SlabShape::texels; ++k) {
        const double mu_s = sun_of_texel(k / Sizes::nu);
        ray.suns.push_back({mu_s, nu_of(k % Sizes::nu, mu, mu_s)});
      }
      for (const RayNode& node : ray_nodes(shells_, table_ray(shells_, height, mu, ground))) {
        const double h = std::min(node.height, thickness());
        Node there{node, r_texel(h, Sizes::r), mu_texel(h, node.mu, ground), {}};
        for (const RaySun& sun : ray.suns) {
          const Between at = sun_texel(sun_along(ray, node, sun));
          there.sun.push_back(static_cast<std::uint16_t>(std::min(
              (at.low + at.part) * SlabShape::parts, (Sizes::mu_s - 1.0) * SlabShape::parts - 1)));
        }
        ray.nodes.push_back(std::move(there));
      }
    }
  });
}

Between BrunetonGeometry::r_texel(double height, int size) const {
  return between(Shared<double>{}.bruneton_unit_from_height(height, bottom(), thickness()), size);
}

Between BrunetonGeometry::mu_texel(double height, double mu, bool ground) const {
  Shared<double> shared;
  Between at = between(ground ? shared.unit_from_ground_ray(height, mu, bottom())
                              : shared.unit_from_upward_ray(height, mu, bottom(), thickness()),
                       kHalf);
  if (!ground) at.low += kHalf;
  return at;
}

Between BrunetonGeometry::sun_texel(double mu_s) const {
  const Between at = between(0.5 * (mu_s + 1), kSunPositions);
  const float* near = &sun_position_[static_cast<std::size_t>(at.low)];
  const double position =
      (1 - at.part) * static_cast<double>(near[0]) + at.part * static_cast<double>(near[1]);
  const int low = std::min(static_cast<int>(position), Sizes::mu_s - 2);
  return {low, position - low};
}

}  // namespace skyfit::literature
