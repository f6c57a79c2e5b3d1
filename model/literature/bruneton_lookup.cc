// SPDX-License-Identifier: Apache-2.0
// What the finished tables say; bruneton_tables.cc fills them.
#include <numbers>

#include "model/atmosphere/phase_moments.h"
#include "model/geometry/sun_disc.h"
#include "model/literature/bruneton_tables.h"
#include "model/shared/shared.h"

namespace skyfit::literature {
namespace {
using Sizes = BrunetonSizes;
}

template <int N>
Dual<N> BrunetonTables<N>::optical_depth(double height, double mu) const {
  return optical_depth_.linear({geometry_.r_texel(height, Sizes::transmittance_r),
                                between(Shared<double>{}.unit_from_upward_ray(
                                            height, mu, geometry_.bottom(), geometry_.thickness()),
                                        Sizes::transmittance_mu)});
}

template <int N>
typename BrunetonTables<N>::InScatter BrunetonTables<N>::in_scatter(double height, double mu,
                                                                    double mu_s, double nu,
                                                                    bool ground) const {
  const std::array<Between, 4> at = {
      geometry_.r_texel(height, Sizes::r), geometry_.mu_texel(height, mu, ground),
      geometry_.sun_texel(mu_s), between(Shared<double>{}.bruneton_unit_from_nu(nu), Sizes::nu)};
  const double dusk = deep_twilight(mu_s, kTableLowestSun);
  return {dusk * rayleigh_like_.linear(at), dusk * single_mie_.linear(at)};
}

template <int N>
Dual<N> BrunetonTables<N>::sky_irradiance(double height, double mu_s) const {
  return irradiance_.linear({between(height / geometry_.thickness(), Sizes::irradiance_r),
                             between(0.5 * (mu_s + 1), Sizes::irradiance_mu_s)});
}

template <int N>
RayLight<N> BrunetonTables<N>::light(const View& view) const {
  const ViewRay& ray = view.ray;
  RayLight<N> light;
  if (ray.length > 0) {
    const InScatter in =
        in_scatter(ray.entry_height, ray.entry_mu, view.mu_s, view.nu, ray.hits_ground);
    light.air = Shared<double>{}.rayleigh_phase(air_.depolarisation, view.nu) * in.rayleigh_like;
    light.aerosol = phase_value(air_.phase, view.nu) * in.single_mie;
  }
  if (ray.hits_ground) {
    light.ground = ground_light(geometry_.shells(), air_, view,
                                [&](double mu_s) { return sky_irradiance(0, mu_s); });
  }
  return light;
}

template <int N>
SkyRayTexels BrunetonTables<N>::sky_rays() const {
  constexpr int kHalf = Sizes::mu / 2;
  SkyRayTexels sky;
  sky.air = sky.aerosol = {Sizes::nu * Sizes::mu_s, kHalf, Sizes::r, {}};
  for (int r = 0; r < Sizes::r; ++r) {
    for (int mu = kHalf; mu < Sizes::mu; ++mu) {
      for (int i = 0; i < sky.air.width; ++i) {
        const std::array<int, 4> at = {r, mu, i % Sizes::mu_s, i / Sizes::mu_s};
        sky.air.values.push_back(static_cast<float>(rayleigh_like_.at(at).v));
        sky.aerosol.values.push_back(static_cast<float>(single_mie_.at(at).v));
      }
    }
  }
  return sky;
}

template <int N>
std::size_t BrunetonTables<N>::bytes() const {
  return optical_depth_.bytes() + irradiance_.bytes() + rayleigh_like_.bytes() +
         single_mie_.bytes();
}

template class BrunetonTables<0>;
template class BrunetonTables<kTablesAtOnce>;

}  // namespace skyfit::literature
