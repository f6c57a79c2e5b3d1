// SPDX-License-Identifier: Apache-2.0
#include "model/literature/schafhitzel_tables.h"

#include <tbb/parallel_for.h>

#include <numbers>

#include "model/atmosphere/phase_moments.h"
#include "model/shared/shared.h"

namespace skyfit::literature {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kSize = SchafhitzelSizes::table;

double angle_of(int texel) { return kPi * unit_of(texel, kSize); }

}  // namespace

template <int N>
SchafhitzelTables<N>::SchafhitzelTables(const SchafhitzelGeometry& geometry, const ClearAir<N>& air,
                                        std::span<const View> views)
    : geometry_(geometry),
      air_(air),
      air_table_({kSize, kSize, kSize}),
      aerosol_table_(air_table_),
      air_phase_({SchafhitzelSizes::phase}),
      aerosol_phase_(air_phase_) {
  for (int i = 0; i < SchafhitzelSizes::phase; ++i) {
    const double nu = std::cos(kPi * unit_of(i, SchafhitzelSizes::phase));
    air_phase_.at({i}) = Shared<double>{}.rayleigh_phase(air.depolarisation, nu);
    aerosol_phase_.at({i}) = phase_value(air.phase, nu);
  }
  std::vector<char> wanted(air_table_.count(), views.empty());
  for (const View& view : views) {
    const std::array<Between, 3> at = place(view);
    for (unsigned corner = 0; corner < 8; ++corner) {
      const auto texel = [&](std::size_t axis) {
        return at[axis].low + static_cast<int>(corner >> axis & 1u);
      };
      wanted[air_table_.index({texel(0), texel(1), texel(2)})] = true;
    }
  }
  const Shells& shells = geometry.shells();
  const SunColumns<N> sun(shells, [&](double height, double mu) {
    return air.optical_depth(shells.columns_to_top(height, mu));
  });
  tbb::parallel_for(0, kSize * kSize, [&](int i) { fill_ray(i / kSize, i % kSize, sun, wanted); });
}

template <int N>
void SchafhitzelTables<N>::fill_ray(int height, int view, const SunColumns<N>& sun,
                                    const std::vector<char>& wanted) {
  const std::size_t first = air_table_.index({height, view, 0});
  const auto begin = wanted.begin() + static_cast<std::ptrdiff_t>(first);
  if (std::none_of(begin, begin + kSize, [](char want) { return want != 0; })) return;
  const Shells& shells = geometry_.shells();
  const double h = shells.top * unit_of(height, kSize), mu = std::cos(angle_of(view));
  const double bottom = shells.bottom_radius;
  const bool ground = Shared<double>{}.ray_hits_ground(h, mu, bottom);
  for (const RayNode& node : ray_nodes(shells, table_ray(shells, h, mu, ground))) {
    const auto density = air_.densities(node.height);
    const Dual<N> through = node.weight * exp(-air_.optical_depth(node.columns));
    const Dual<N> by_air = through * air_.air * density.air,
                  by_aerosol = through * air_.aerosol_scattering * density.aerosol;
    const Between row = sun.row(node.height);
    for (int s = 0; s < kSize; ++s) {
      if (!begin[s]) continue;
      const double mu_s = std::cos(angle_of(s)), nu = std::cos(angle_of(view) - angle_of(s));
      const double there = ((bottom + h) * mu_s + node.s * nu) / (bottom + node.height);
      const Dual<N> light = sun.light(row, std::clamp(there, -1.0, 1.0));
      const std::size_t texel = first + static_cast<std::size_t>(s);
      add_product(by_air, light, air_table_[texel]);
      add_product(by_aerosol, light, aerosol_table_[texel]);
    }
  }
}

template <int N>
std::array<Between, 3> SchafhitzelTables<N>::place(double height, double view_zenith,
                                                   double sun_zenith) const {
  return air_table_.between_texels(
      {height / geometry_.shells().top, view_zenith / kPi, sun_zenith / kPi});
}
template <int N>
std::array<Between, 3> SchafhitzelTables<N>::place(const View& view) const {
  return place(view.ray.entry_height, std::acos(std::clamp(view.ray.entry_mu, -1.0, 1.0)),
               std::acos(view.mu_s));
}

template <int N>
typename SchafhitzelTables<N>::InScatter SchafhitzelTables<N>::in_scatter(double height,
                                                                          double view_zenith,
                                                                          double sun_zenith) const {
  const std::array<Between, 3> at = place(height, view_zenith, sun_zenith);
  return {air_table_.linear(at), aerosol_table_.linear(at)};
}

template <int N>
RayLight<N> SchafhitzelTables<N>::light(const View& view) const {
  RayLight<N> light;
  if (view.ray.length > 0) {
    const std::array<Between, 3> at = place(view);
    const std::array<Between, 1> angle =
        air_phase_.between_texels({std::acos(std::clamp(view.nu, -1.0, 1.0)) / kPi});
    light.air = air_phase_.linear(angle) * air_table_.linear(at);
    light.aerosol = aerosol_phase_.linear(angle) * aerosol_table_.linear(at);
  }
  if (view.ray.hits_ground) {
    light.ground =
        ground_light(geometry_.shells(), air_, view, [](double) { return Dual<N>(0.0); });
  }
  return light;
}

template <int N>
SkyRayTexels SchafhitzelTables<N>::sky_rays() const {
  SkyRayTexels sky;
  sky.air = sky.aerosol = {kSize, kSize, kSize, {}};
  for (std::size_t i = 0; i < air_table_.count(); ++i) {
    sky.air.values.push_back(static_cast<float>(air_table_[i].v));
    sky.aerosol.values.push_back(static_cast<float>(aerosol_table_[i].v));
  }
  return sky;
}

template <int N>
std::size_t SchafhitzelTables<N>::bytes() const {
  return air_table_.bytes() + aerosol_table_.bytes() + air_phase_.bytes() + aerosol_phase_.bytes();
}

template class SchafhitzelTables<0>;
template class SchafhitzelTables<kTablesAtOnce>;

}  // namespace skyfit::literature
