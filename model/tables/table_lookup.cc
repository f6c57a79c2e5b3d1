// SPDX-License-Identifier: Apache-2.0
#include "model/tables/table_lookup.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "model/atmosphere/phase_moments.h"
#include "model/shared/shared.h"

namespace skyfit {
namespace {

Shared<double> shared;  // stateless

struct Planet {
  explicit Planet(const AtmosphereTables& tables)
      : bottom(tables.atmosphere.bottom_radius_m),
        thickness(tables.atmosphere.top_radius_m - bottom) {}
  double bottom, thickness;
};

// The two texels about a texture coordinate, clamped to the edge, as OpenGL's linear filter takes
// them.
struct Between {
  Between(double u, int size) {
    const double x = std::clamp(u * size - 0.5, 0.0, size - 1.0);
    low = std::min(static_cast<int>(x), std::max(size - 2, 0));
    high = std::min(low + 1, size - 1);
    part = x - low;
  }
  // The same place in a table that begins so many texels later.
  Between later(int texels) const {
    Between there = *this;
    there.low += texels;
    there.high += texels;
    return there;
  }
  int low, high;
  double part;
};

void accumulate(const Table& table, int x, int y, int z, double weight, NodeValues& sum) {
  const std::size_t texel = (static_cast<std::size_t>(z) * table.height + y) * table.width + x;
  for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * table.rgba[4 * texel + k];
}

void accumulate(const Table& table, const Between& x, const Between& y, const Between& z,
                double weight, NodeValues& sum) {
  for (const int zi : {z.low, z.high}) {
    const double wz = weight * (zi == z.low ? 1 - z.part : z.part);
    accumulate(table, x.low, y.low, zi, wz * (1 - x.part) * (1 - y.part), sum);
    accumulate(table, x.high, y.low, zi, wz * x.part * (1 - y.part), sum);
    accumulate(table, x.low, y.high, zi, wz * (1 - x.part) * y.part, sum);
    accumulate(table, x.high, y.high, zi, wz * x.part * y.part, sum);
    if (z.low == z.high) break;
  }
}

double height_coordinate(const AtmosphereTables& tables, double height, int size) {
  return shared.texture_from_unit(tables.heights.unit(height, Planet(tables).thickness), size);
}

double sun_coordinate(double sun_height, int size) {
  return shared.texture_from_unit(shared.unit_from_sun(sun_height, kTableLowestSun), size);
}

// A whole ray as the tables of mean amplitudes see it.
struct TableRay {
  TableRay(const AtmosphereTables& of, const TablePlace& begin, double nu_of_ray, bool ground)
      : tables(of), planet(of), from(begin), nu(nu_of_ray), hits_ground(ground) {
    const TablePlace at =
        place_along(tables, from, nu,
                    shared.distance_to_sun_point(from.height, from.mu, hits_ground, planet.bottom,
                                                 planet.thickness));
    azimuth = shared.unit_from_azimuth(shared.cosine_of_azimuth(at.mu, at.mu_s, nu));
    sun = shared.sun_height(at.height, at.mu_s, planet.bottom);
  }

  // `deck`: that of the tables whose texels these are.
  Between view(const RayTexels& texels, double deck) const {
    return {shared.texture_from_view(from.height, from.mu, hits_ground, texels.ground, texels.sky,
                                     planet.bottom, planet.thickness, deck),
            texels.rows()};
  }

  // docs/theory (9.9).
  // From the logarithms of the amplitudes.
  NodeValues radiance(const NodeValues& rayleigh_like, std::span<const NodeValues> single,
                      const PhaseClasses& phases) const {
    const double rayleigh_phase = shared.rayleigh_phase(phases.depolarisation, nu);
    const double light = light_of_mean();
    NodeValues sum;
    for (std::size_t k = 0; k < 4; ++k)
      sum[k] = light * std::exp(rayleigh_like[k]) * rayleigh_phase;
    for (std::size_t c = 0; c < single.size(); ++c) {
      const NodeValues phase = phase_values(phases.others[c]);
      for (std::size_t k = 0; k < 4; ++k) sum[k] += light * std::exp(single[c][k]) * phase[k];
    }
    return sum;
  }

  // The amplitude of a ray whose mean, as the tables hold it, is 1 / km.
  double light_of_mean() const {
    const double length =
        hits_ground ? shared.distance_to_inner_sphere(planet.bottom, from.height, from.mu, 0.0)
                    : shared.distance_to_outer_sphere(planet.bottom, from.height, from.mu,
                                                      planet.thickness);
    return 1e-3 * length * deep_twilight(sun, kTableLowestSun);
  }

  NodeValues phase_values(const PhaseFunction<double>& phase) const {
    NodeValues values;
    if (!depends_on_wavelength(phase.type)) {
      values.fill(phase_value(phase, nu));
      return values;
    }
    for (std::size_t k = 0; k < 4; ++k)
      values[k] = phase_value(phase_at(phase, tables.color.nodes[k].wavelength_nm), nu);
    return values;
  }

  const AtmosphereTables& tables;
  Planet planet;
  TablePlace from;
  double nu;
  bool hits_ground;
  double azimuth, sun;  // 0..1; by sun_height() of model/shared/mapping.glsl
};

// What the scattering tables hold of a ray, with a weight.
void accumulate_ray(const AtmosphereTables& tables, const TableRay& ray, double share,
                    NodeValues& rayleigh_like, std::span<NodeValues> single) {
  const TableSizes& s = tables.sizes;
  const double turn = ray.azimuth * (s.scattering_azimuth - 1);
  const int first = std::min(static_cast<int>(turn), s.scattering_azimuth - 2);
  const Between v = ray.view(s.scattering(), tables.heights.deck(ray.planet.thickness));
  const Between w(height_coordinate(tables, ray.from.height, s.scattering_r), s.scattering_r);
  Between u(sun_coordinate(ray.sun, s.scattering_mu_s), s.scattering_mu_s);
  u.low += first * s.scattering_mu_s;
  u.high += first * s.scattering_mu_s;
  for (const double weight : {1 - turn + first, turn - first}) {
    accumulate(tables.rayleigh_like, u, v, w, share * weight, rayleigh_like);
    for (std::size_t c = 0; c < single.size(); ++c)
      accumulate(tables.single, u, v, w.later(static_cast<int>(c) * s.scattering_r), share * weight,
                 single[c]);
    u.low += s.scattering_mu_s;
    u.high += s.scattering_mu_s;
  }
}

}  // namespace

TablePlace place_along(const AtmosphereTables& tables, const TablePlace& from, double nu,
                       double distance) {
  const Planet p(tables);
  const double h = std::max(shared.height_after(p.bottom, from.height, from.mu, distance), 0.0);
  const double r = p.bottom + h, r0 = p.bottom + from.height;
  return {std::min(h, p.thickness), std::clamp((r0 * from.mu + distance) / r, -1.0, 1.0),
          std::clamp((r0 * from.mu_s + distance * nu) / r, -1.0, 1.0)};
}

// docs/theory (9.10).
NodeValues lookup_transmittance(const AtmosphereTables& tables, const TablePlace& from,
                                const TablePlace& to, bool downward) {
  const double sign = downward ? -1 : 1;
  const TablePlace &low = downward ? to : from, &high = downward ? from : to;
  const NodeValues whole = lookup_optical_depth(tables, low.height, sign * low.mu),
                   rest = lookup_optical_depth(tables, high.height, sign * high.mu);
  NodeValues value;
  for (std::size_t k = 0; k < 4; ++k) value[k] = std::exp(-std::max(whole[k] - rest[k], 0.0));
  return value;
}

NodeValues lookup_optical_depth(const AtmosphereTables& tables, double height, double mu) {
  const Planet p(tables);
  const Table& table = tables.optical_depth;
  NodeValues sum{};
  const double x = shared.texture_from_unit(
      shared.unit_from_upward_ray(height, mu, p.bottom, p.thickness), table.width);
  accumulate(table, Between(x, table.width),
             Between(height_coordinate(tables, height, table.height), table.height),
             Between(0.5, 1), 1, sum);
  return sum;
}

NodeValues lookup_sun_transmittance(const AtmosphereTables& tables, double height, double mu_s) {
  const double bottom = tables.atmosphere.bottom_radius_m;
  const double visible =
      visible_sun(bottom, height, mu_s, tables.atmosphere.star.angular_radius_rad());
  if (visible <= 0) return {};
  NodeValues value =
      lookup_optical_depth(tables, height, std::max(mu_s, horizon_cosine(bottom, height)));
  for (double& v : value) v = visible * std::exp(-v);
  return value;
}

NodeValues lookup_irradiance(const AtmosphereTables& tables, double height, double mu_s) {
  const Table& table = tables.irradiance;
  const double sun = shared.sun_height(height, mu_s, tables.atmosphere.bottom_radius_m);
  NodeValues sum{};
  accumulate(table, Between(sun_coordinate(sun, table.width), table.width),
             Between(height_coordinate(tables, height, table.height), table.height),
             Between(0.5, 1), deep_twilight(sun, kTableLowestSun), sum);
  return sum;
}

NodeValues lookup_radiance(const AtmosphereTables& tables, double height, double mu, double mu_s,
                           double nu, bool hits_ground) {
  return lookup_changed_radiance(tables, {}, tables.phases, {height, mu, mu_s}, nu, hits_ground);
}

std::vector<NodeValues> lookup_amplitudes(const AtmosphereTables& tables, const TablePlace& from,
                                          double nu, bool hits_ground) {
  const TableRay ray(tables, from, nu, hits_ground);
  std::vector<NodeValues> values(1 + tables.phases.others.size());
  accumulate_ray(tables, ray, 1, values[0], std::span(values).subspan(1));
  const double light = ray.light_of_mean();
  for (NodeValues& part : values) {
    for (double& value : part) value = light * std::exp(value);
  }
  return values;
}

NodeValues lookup_changed_radiance(const AtmosphereTables& tables,
                                   std::span<const WeightedTables> changes,
                                   const PhaseClasses& phases, const TablePlace& from, double nu,
                                   bool hits_ground) {
  const TableRay ray(tables, from, nu, hits_ground);
  NodeValues rayleigh_like{};
  std::array<NodeValues, kMostConstituents> values{};
  const std::span single(values.data(), phases.others.size());
  accumulate_ray(tables, ray, 1, rayleigh_like, single);
  for (const WeightedTables& change : changes)
    accumulate_ray(change.tables, ray, change.weight, rayleigh_like, single);
  return ray.radiance(rayleigh_like, single, phases);
}

NodeValues lookup_radiance_from_outside(const AtmosphereTables& tables, double mu, double mu_s,
                                        double nu) {
  const TableRay ray(tables, {Planet(tables).thickness, mu, mu_s}, nu, false);
  const RayTexels texels = tables.sizes.outside();
  const Between u(sun_coordinate(ray.sun, texels.mu_s), texels.mu_s),
      v(shared.texture_from_unit(ray.azimuth, texels.azimuth), texels.azimuth),
      w = ray.view(texels, tables.heights.deck(ray.planet.thickness));
  NodeValues rayleigh_like{};
  std::array<NodeValues, kMostConstituents> values{};
  const std::span single(values.data(), tables.phases.others.size());
  accumulate(tables.sky_rays.air, u, v, w, 1, rayleigh_like);
  for (std::size_t c = 0; c < single.size(); ++c)
    accumulate(tables.sky_rays.aerosol, u, v, w.later(static_cast<int>(c) * texels.rows()), 1,
               single[c]);
  return ray.radiance(rayleigh_like, single, tables.phases);
}

}  // namespace skyfit
