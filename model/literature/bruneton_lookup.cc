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

std::array<Between, 2> place_of_transmittance(const BrunetonGeometry& geometry, double height,
                                              double mu) {
  return {geometry.r_texel(height, Sizes::transmittance_r),
          between(Shared<double>{}.unit_from_upward_ray(height, mu, geometry.bottom(),
                                                        geometry.thickness()),
                  Sizes::transmittance_mu)};
}
}  // namespace

template <int N>
Dual<N> BrunetonTables<N>::optical_depth(double height, double mu) const {
  return optical_depth_.linear(place_of_transmittance(geometry_, height, mu));
}

template <int N>
typename BrunetonTables<N>::InScatter BrunetonTables<N>::in_scatter(double height, double mu,
                                                                    double mu_s, double nu,
                                                                    bool ground) const {
  return in_scatter_at(geometry_.r_texel(height, Sizes::r), geometry_.mu_texel(height, mu, ground),
                       mu_s, nu);
}

template <int N>
typename BrunetonTables<N>::InScatter BrunetonTables<N>::in_scatter_by_radii(double height,
                                                                             double mu, double mu_s,
                                                                             double nu) const {
  Shared<float> shared;
  const auto km = [](double m) { return static_cast<float>(1e-3 * m); };
  const float bottom = km(geometry_.bottom()), top = bottom + km(geometry_.thickness()),
              r = bottom + km(height), cosine = static_cast<float>(mu);
  const bool ground = shared.bruneton_meets_ground(r, cosine, bottom);
  Between at_mu =
      between(double{ground ? shared.bruneton_ground_unit_by_radius(r, cosine, bottom)
                            : shared.bruneton_sky_unit_by_radius(r, cosine, bottom, top)},
              Sizes::mu / 2);
  if (!ground) at_mu.low += Sizes::mu / 2;
  return in_scatter_at(between(double{shared.bruneton_unit_from_radius(r, bottom, top)}, Sizes::r),
                       at_mu, mu_s, nu);
}

template <int N>
typename BrunetonTables<N>::InScatter BrunetonTables<N>::in_scatter_at(const Between& r,
                                                                       const Between& mu,
                                                                       double mu_s,
                                                                       double nu) const {
  const std::array<Between, 4> at = {
      r, mu, geometry_.sun_texel(mu_s),
      between(Shared<double>{}.bruneton_unit_from_nu(nu), Sizes::nu)};
  const double dusk = deep_twilight(mu_s, kTableLowestSun);
  return {dusk * rayleigh_like_.linear(at), dusk * single_mie_.linear(at)};
}

template <int N>
Dual<N> BrunetonTables<N>::half_transmittance(double height, double mu) const {
  return half_transmittance_.linear(place_of_transmittance(geometry_, height, mu));
}

template <int N>
Dual<N> BrunetonTables<N>::half_transmittance_to_ground(const ViewRay& ray) const {
  // Both ends as upward rays; the ground is the lower.
  const double mu = ray_point(ray, geometry_.bottom(), ray.length).mu;
  const Dual<N> whole = half_transmittance(0, -mu),
                rest = half_transmittance(ray.entry_height, -ray.entry_mu);
  return whole.v < rest.v ? whole / rest : Dual<N>(1.0);
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
  if (choices_.in_scatter == BrunetonInScatter::kExact) {
    light = scattered(view);
  } else if (ray.length > 0) {
    light =
        with_phases(view, in_scatter_by_radii(ray.entry_height, ray.entry_mu, view.mu_s, view.nu));
  }
  if (ray.hits_ground) {
    light.ground = ground_light(
        geometry_.shells(), air_, view, [&](double mu_s) { return sky_irradiance(0, mu_s); },
        choices_.transmittance == BrunetonTransmittance::kInHalfFloats
            ? half_transmittance_to_ground(ray)
            : transmittance_to_ground(geometry_.shells(), air_, ray));
  }
  return light;
}

template <int N>
RayLight<N> BrunetonTables<N>::scattered(const View& view) const {
  const ViewRay& ray = view.ray;
  if (ray.length <= 0) return {};
  return with_phases(
      view, in_scatter(ray.entry_height, ray.entry_mu, view.mu_s, view.nu, ray.hits_ground));
}

template <int N>
RayLight<N> BrunetonTables<N>::with_phases(const View& view, const InScatter& in) const {
  RayLight<N> light;
  light.air = Shared<double>{}.rayleigh_phase(air_.depolarisation, view.nu) * in.rayleigh_like;
  light.aerosol = phase_value(air_.phase, view.nu) * in.single_mie;
  return light;
}

template <int N>
SkyRayTexels BrunetonTables<N>::sky_rays() const {
  const int first = choices_.in_scatter == BrunetonInScatter::kInHalfFloats ? 0 : Sizes::mu / 2;
  SkyRayTexels sky;
  sky.air = sky.aerosol = {Sizes::nu * Sizes::mu_s, Sizes::mu - first, Sizes::r, {}};
  for (int r = 0; r < Sizes::r; ++r) {
    for (int mu = first; mu < Sizes::mu; ++mu) {
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
  return optical_depth_.bytes() + half_transmittance_.bytes() + irradiance_.bytes() +
         rayleigh_like_.bytes() + single_mie_.bytes();
}

template class BrunetonTables<0>;
template class BrunetonTables<kTablesAtOnce>;

}  // namespace skyfit::literature
