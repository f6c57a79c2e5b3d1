// SPDX-License-Identifier: Apache-2.0
#include "model/literature/bodare_tables.h"

#include <tbb/parallel_for.h>

#include <numbers>

#include "model/atmosphere/phase_moments.h"
#include "model/literature/mie_from_rayleigh.h"
#include "model/shared/shared.h"

namespace skyfit::literature {
namespace {

using Sizes = BodareSizes;
constexpr double kPi = std::numbers::pi;
constexpr int kHalf = Sizes::view / 2;
constexpr int kTheta = 96, kPhi = 64;  // directions of the gathering, phi over half the circle

double theta_of(int i) { return kPi * (i + 0.5) / kTheta; }

}  // namespace

BodareGeometry::BodareGeometry(const Atmosphere<double>& atmosphere)
    : shells_(shells_of(atmosphere, Keep::kAll)),
      rays_(static_cast<std::size_t>(Sizes::height) * Sizes::view) {
  Shared<double> shared;
  const double bottom = shells_.bottom_radius;
  tbb::parallel_for(0, Sizes::height, [&](int i) {
    const double h = height(i), horizon = shared.bodare_horizon(h, bottom);
    for (int v = 0; v < Sizes::view; ++v) {
      const bool ground = v < kHalf;
      const double unit = unit_of(ground ? v : v - kHalf, kHalf);
      const double mu = std::clamp(ground ? shared.bodare_ground_view_from_unit(unit, horizon)
                                          : shared.bodare_sky_view_from_unit(unit, horizon),
                                   -1.0, 1.0);
      Ray& ray = rays_[static_cast<std::size_t>(i * Sizes::view + v)];
      for (const RayNode& node : ray_nodes(shells_, table_ray(shells_, h, mu, ground))) {
        Node there{node, {}};
        for (int s = 0; s < Sizes::sun; ++s) {
          const double mu_s = sun(s);
          const double nu = mu * mu_s + std::sqrt(std::max((1 - mu * mu) * (1 - mu_s * mu_s), 0.0));
          there.mu_s.push_back(
              std::clamp(((bottom + h) * mu_s + node.s * nu) / (bottom + node.height), -1.0, 1.0));
        }
        ray.push_back(std::move(there));
      }
    }
  });
}

double BodareGeometry::height(int texel) const {
  return Shared<double>{}.bodare_height_from_unit(unit_of(texel, Sizes::height), shells_.top);
}
Between BodareGeometry::height_texel(double h) const {
  return between(Shared<double>{}.bodare_unit_from_height(h, shells_.top), Sizes::height);
}
Between BodareGeometry::view_texel(double h, double mu, bool ground) const {
  Shared<double> shared;
  const double horizon = shared.bodare_horizon(h, shells_.bottom_radius);
  Between at = between(ground ? shared.bodare_unit_from_ground_view(mu, horizon)
                              : shared.bodare_unit_from_sky_view(mu, horizon),
                       kHalf);
  if (!ground) at.low += kHalf;
  return at;
}
Between BodareGeometry::sun_texel(double mu_s) {
  return between(Shared<double>{}.bodare_unit_from_sun(mu_s), Sizes::sun);
}
double BodareGeometry::sun(int texel) {
  return std::clamp(Shared<double>{}.bodare_sun_from_unit(unit_of(texel, Sizes::sun)), -1.0, 1.0);
}

template <int N>
BodareTables<N>::BodareTables(const BodareGeometry& geometry, const ClearAir<N>& air)
    : geometry_(geometry),
      air_(air),
      sun_(geometry.shells(),
           [&](double height, double mu) {
             return air.optical_depth(geometry.shells().columns_to_top(height, mu));
           }),
      air_order_({Sizes::height, Sizes::view, Sizes::sun}),
      aerosol_order_(air_order_),
      air_sum_(air_order_),
      aerosol_sum_(air_order_),
      gathered_({Sizes::height, Sizes::sun}),
      gathered_sum_(gathered_),
      ground_(Sizes::sun) {
  make_mean_phases();
}

template <int N>
BodareTables<N>::BodareTables(const BodareGeometry& geometry, const ClearAir<N>& air,
                              std::span<const View>)
    : BodareTables(geometry, air) {
  const auto all_slices = [](const auto& slices) {
    tbb::parallel_for(0, Sizes::height, [&](int i) { slices(i, i + 1); });
  };
  all_slices([&](int first, int last) { scatter_once(first, last); });
  add_order();
  for (int k = 2; k <= kOrders; ++k) {
    gather();
    all_slices([&](int first, int last) { scatter_gathered(first, last); });
    add_order();
  }
  finish();
}

// Over the azimuth, scaled so that the aerosol's phase function integrates to 1 over the sphere:
// the polar angles do not resolve a forward peak.
template <int N>
void BodareTables<N>::make_mean_phases() {
  mean_aerosol_.resize(static_cast<std::size_t>(Sizes::sun) * kTheta);
  mean_air_.resize(mean_aerosol_.size());
  tbb::parallel_for(0, Sizes::sun, [&](int s) {
    const double mu_s = geometry_.sun(s), sun_sine = std::sqrt(std::max(1 - mu_s * mu_s, 0.0));
    Dual<N> sum(0.0);
    for (int t = 0; t < kTheta; ++t) {
      const std::size_t at = static_cast<std::size_t>(s * kTheta + t);
      const double z = std::cos(theta_of(t)), sine = std::sin(theta_of(t));
      for (int f = 0; f < kPhi; ++f) {
        const double nu =
            std::clamp(z * mu_s + sine * sun_sine * std::cos(kPi * (f + 0.5) / kPhi), -1.0, 1.0);
        add_scaled(2 * kPi / kPhi, phase_value(air_.phase, nu), mean_aerosol_[at]);
        mean_air_[at] += 2 * kPi / kPhi * Shared<double>{}.elek_rayleigh_phase(nu);
      }
      add_scaled(sine * kPi / kTheta, mean_aerosol_[at], sum);
    }
    for (int t = 0; t < kTheta; ++t) mean_aerosol_[static_cast<std::size_t>(s * kTheta + t)] /= sum;
  });
}

template <int N>
Dual<N> BodareTables<N>::azimuth_sum(int sun, int theta, const Dual<N>& air,
                                     const Dual<N>& aerosol) const {
  const std::size_t at = static_cast<std::size_t>(sun * kTheta + theta);
  return mean_air_[at] * air + mean_aerosol_[at] * aerosol;
}

// Light that is scattered along every ray of the slices; light(row, mu_s) is what falls on a node,
// row(height) its first coordinate.
template <int N>
template <class Row, class Light>
void BodareTables<N>::scatter(int first, int last, const Row& row_of, const Light& light_at) {
  for (int i = first; i < last; ++i) {
    for (int v = 0; v < Sizes::view; ++v) {
      Dual<N>*air = &air_order_.at({i, v, 0}), *aerosol = &aerosol_order_.at({i, v, 0});
      std::fill_n(air, Sizes::sun, Dual<N>(0.0));
      std::fill_n(aerosol, Sizes::sun, Dual<N>(0.0));
      for (const BodareGeometry::Node& node : geometry_.ray(i, v)) {
        const auto density = air_.densities(node.at.height);
        const Dual<N> through = node.at.weight * exp(-air_.optical_depth(node.at.columns));
        const Dual<N> by_air = through * air_.air * density.air,
                      by_aerosol = through * air_.aerosol_scattering * density.aerosol;
        const Between row = row_of(node.at.height);
        for (int s = 0; s < Sizes::sun; ++s) {
          const Dual<N> light = light_at(row, node.mu_s[static_cast<std::size_t>(s)]);
          add_product(by_air, light, air[s]);
          add_product(by_aerosol, light, aerosol[s]);
        }
      }
    }
  }
}

template <int N>
void BodareTables<N>::scatter_once(int first, int last) {
  scatter(
      first, last, [&](double height) { return sun_.row(height); },
      [&](const Between& row, double mu_s) { return sun_.light(row, mu_s); });
}

template <int N>
void BodareTables<N>::scatter_gathered(int first, int last) {
  scatter(
      first, last, [&](double height) { return geometry_.height_texel(height); },
      [&](const Between& row, double mu_s) {
        return gathered_.linear({row, BodareGeometry::sun_texel(mu_s)});
      });
}

template <int N>
void BodareTables<N>::gather() {
  tbb::parallel_for(0, Sizes::height, [&](int i) {
    const double h = geometry_.height(i);
    for (int s = 0; s < Sizes::sun; ++s) gathered_.at({i, s}) = Dual<N>(0.0);
    for (int t = 0; t < kTheta; ++t) {
      const double mu = std::cos(theta_of(t));
      const bool ground = Shared<double>{}.ray_hits_ground(h, mu, geometry_.shells().bottom_radius);
      const Between view = geometry_.view_texel(h, mu, ground);
      const double weight = std::sin(theta_of(t)) * kPi / kTheta;
      const auto at = [&](const Table& table, int s) {
        return (1 - view.part) * table.at({i, view.low, s}) +
               view.part * table.at({i, view.low + 1, s});
      };
      for (int s = 0; s < Sizes::sun; ++s) {
        add_scaled(weight, azimuth_sum(s, t, at(air_order_, s), at(aerosol_order_, s)),
                   gathered_.at({i, s}));
      }
    }
    for (int s = 0; s < Sizes::sun; ++s) gathered_sum_.at({i, s}) += gathered_.at({i, s});
  });
}

template <int N>
void BodareTables<N>::add_order() {
  for (std::size_t i = 0; i < air_sum_.count(); ++i) {
    air_sum_[i] += air_order_[i];
    aerosol_sum_[i] += aerosol_order_[i];
  }
}

template <int N>
void BodareTables<N>::light_ground() {
  for (int s = 0; s < Sizes::sun; ++s) {
    ground_[static_cast<std::size_t>(s)] = Dual<N>(0.0);
    for (int t = 0; 2 * t < kTheta; ++t) {
      const double mu = std::cos(theta_of(t));
      const Between view = geometry_.view_texel(0, mu, false);
      const auto at = [&](const Table& table) {
        return (1 - view.part) * table.at({0, view.low, s}) +
               view.part * table.at({0, view.low + 1, s});
      };
      add_scaled(mu * std::sin(theta_of(t)) * kPi / kTheta,
                 azimuth_sum(s, t, at(air_sum_), at(aerosol_sum_)),
                 ground_[static_cast<std::size_t>(s)]);
    }
  }
}

// The tables of single orders have done their work.
template <int N>
void BodareTables<N>::finish() {
  light_ground();
  air_order_ = aerosol_order_ = Table({0, 0, 0});
}

template <int N>
typename BodareTables<N>::InScatter BodareTables<N>::in_scatter(double height, double mu,
                                                                double mu_s, bool ground) const {
  const std::array<Between, 3> at = {geometry_.height_texel(height),
                                     geometry_.view_texel(height, mu, ground),
                                     BodareGeometry::sun_texel(mu_s)};
  const double dusk = deep_twilight(mu_s, BodareGeometry::sun(0));
  return {dusk * air_sum_.linear(at), dusk * aerosol_sum_.linear(at)};
}

template <int N>
void BodareTables<N>::take_aerosol_from_air(const BodareTables& red) {
  take_mie_from_rayleigh(air_, air_sum_, red.air_, red.air_sum_, red.aerosol_sum_, aerosol_sum_);
  light_ground();
}

template <int N>
Dual<N> BodareTables<N>::gathered(double height, double mu_s) const {
  return deep_twilight(mu_s, BodareGeometry::sun(0)) *
         gathered_sum_.linear({geometry_.height_texel(height), BodareGeometry::sun_texel(mu_s)});
}

template <int N>
Dual<N> BodareTables<N>::ground_irradiance(double mu_s) const {
  const Between at = BodareGeometry::sun_texel(mu_s);
  return (1 - at.part) * ground_[static_cast<std::size_t>(at.low)] +
         at.part * ground_[static_cast<std::size_t>(at.low + 1)];
}

template <int N>
RayLight<N> BodareTables<N>::light(const View& view) const {
  const ViewRay& ray = view.ray;
  RayLight<N> light;
  if (ray.length > 0) {
    const InScatter in = in_scatter(ray.entry_height, ray.entry_mu, view.mu_s, ray.hits_ground);
    light.air = Shared<double>{}.elek_rayleigh_phase(view.nu) * in.air;
    light.aerosol = phase_value(air_.phase, view.nu) * in.aerosol;
  }
  if (ray.hits_ground) {
    light.ground = ground_light(geometry_.shells(), air_, view,
                                [&](double mu_s) { return ground_irradiance(mu_s); });
  }
  return light;
}

template <int N>
SkyRayTexels BodareTables<N>::sky_rays() const {
  SkyRayTexels sky;
  sky.air = sky.aerosol = {Sizes::sun, kHalf, Sizes::height, {}};
  sky.gathered = {Sizes::sun, Sizes::height, 1, {}};
  for (int i = 0; i < Sizes::height; ++i) {
    for (int v = kHalf; v < Sizes::view; ++v) {
      for (int s = 0; s < Sizes::sun; ++s) {
        sky.air.values.push_back(static_cast<float>(air_sum_.at({i, v, s}).v));
        sky.aerosol.values.push_back(static_cast<float>(aerosol_sum_.at({i, v, s}).v));
      }
    }
    for (int s = 0; s < Sizes::sun; ++s)
      sky.gathered.values.push_back(static_cast<float>(gathered_sum_.at({i, s}).v));
  }
  return sky;
}

template <int N>
std::size_t BodareTables<N>::bytes() const {
  return air_sum_.bytes() + aerosol_sum_.bytes() + gathered_sum_.bytes() +
         ground_.size() * sizeof(Dual<N>);
}

template class BodareTables<0>;
template class BodareTables<kTablesAtOnce>;

}  // namespace skyfit::literature
