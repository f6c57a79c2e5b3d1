// SPDX-License-Identifier: Apache-2.0
#include "model/table_lookup.h"

#include <algorithm>
#include <cmath>

#include "model/phase_moments.h"
#include "model/shared/shared.h"

namespace skyfit {
namespace {

constexpr double kSunRadius = 0.004654793;  // rad, at 1 au

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
  int low, high;
  double part;
};

void accumulate(const Table& table, int x, int y, int z, double weight, NodeValues& sum) {
  const std::size_t texel = (static_cast<std::size_t>(z) * table.height + y) * table.width + x;
  for (std::size_t k = 0; k < 4; ++k) sum[k] += weight * table.rgba[4 * texel + k];
}

void accumulate(const Table& table, double u, double v, double w, double weight, NodeValues& sum) {
  const Between x(u, table.width), y(v, table.height), z(w, table.depth);
  for (const int zi : {z.low, z.high}) {
    const double wz = weight * (zi == z.low ? 1 - z.part : z.part);
    if (z.low == z.high && zi != z.low) continue;
    accumulate(table, x.low, y.low, zi, wz * (1 - x.part) * (1 - y.part), sum);
    accumulate(table, x.high, y.low, zi, wz * x.part * (1 - y.part), sum);
    accumulate(table, x.low, y.high, zi, wz * (1 - x.part) * y.part, sum);
    accumulate(table, x.high, y.high, zi, wz * x.part * y.part, sum);
    if (z.low == z.high) break;
  }
}

// Of the cubic through the values at 0, 1, 2 and 3 (Lagrange).
std::array<double, 4> cubic_weights(double x) {
  const double a = x - 1, b = x - 2, c = x - 3;
  return {-a * b * c / 6, x * b * c / 2, -x * a * c / 2, x * a * b / 6};
}

// Below the lowest sun of the tables the twilight falls by e per degree.
double deep_twilight(double mu_s) {
  return std::exp(std::min((mu_s - kTableLowestSun) * 57.3, 0.0));
}

}  // namespace

NodeValues lookup_optical_depth(const AtmosphereTables& tables, double height, double mu) {
  Shared<double> shared;
  const Planet p(tables);
  const Table& table = tables.optical_depth;
  NodeValues sum{};
  const double x = shared.unit_from_upward_ray(height, mu, p.bottom, p.thickness);
  const double y = shared.unit_from_height(height, p.bottom, p.thickness);
  accumulate(table, shared.texture_from_unit(x, table.width),
             shared.texture_from_unit(y, table.height), 0.5, 1, sum);
  return sum;
}

NodeValues lookup_sun_transmittance(const AtmosphereTables& tables, double height, double mu_s) {
  const double bottom = tables.atmosphere.bottom_radius_m;
  const double sin_horizon = bottom / (bottom + height);
  const double mu_horizon = -std::sqrt(std::max(1 - sin_horizon * sin_horizon, 0.0));
  const double half_disc = sin_horizon * kSunRadius;
  const double t = std::clamp((mu_s - mu_horizon) / (2 * half_disc) + 0.5, 0.0, 1.0);
  if (t <= 0) return {};
  NodeValues value = lookup_optical_depth(tables, height, std::max(mu_s, mu_horizon));
  for (double& v : value) v = t * t * (3 - 2 * t) * std::exp(-v);
  return value;
}

NodeValues lookup_irradiance(const AtmosphereTables& tables, double height, double mu_s) {
  Shared<double> shared;
  const Planet p(tables);
  const Table& table = tables.irradiance;
  NodeValues sum{};
  const double x = shared.unit_from_sun(mu_s, kTableLowestSun, p.bottom, p.thickness);
  const double y = shared.unit_from_height(height, p.bottom, p.thickness);
  accumulate(table, shared.texture_from_unit(x, table.width),
             shared.texture_from_unit(y, table.height), 0.5, deep_twilight(mu_s), sum);
  return sum;
}

NodeValues lookup_radiance(const AtmosphereTables& tables, double height, double mu, double mu_s,
                           double nu, bool hits_ground) {
  Shared<double> shared;
  const Planet p(tables);
  const TableSizes& s = tables.sizes;
  const double sun = shared.texture_from_unit(
      shared.unit_from_sun(mu_s, kTableLowestSun, p.bottom, p.thickness), s.scattering_mu_s);
  const double slot = shared.unit_from_cosine(nu) * (s.scattering_nu - 1);
  const double lower = std::clamp(std::floor(slot) - 1, 0.0, s.scattering_nu - 4.0);
  const double v =
      shared.texture_from_view(height, mu, hits_ground, s.scattering_mu, p.bottom, p.thickness);
  const double w = shared.texture_from_unit(shared.unit_from_height(height, p.bottom, p.thickness),
                                            s.scattering_r);
  NodeValues rayleigh{}, mie{};
  const std::array<double, 4> weight = cubic_weights(slot - lower);
  for (std::size_t i = 0; i < 4; ++i) {
    const double u = (lower + static_cast<double>(i) + sun) / s.scattering_nu;
    accumulate(tables.rayleigh_like, u, v, w, weight[i], rayleigh);
    accumulate(tables.single_mie, u, v, w, weight[i], mie);
  }
  const double rayleigh_phase =
      shared.rayleigh_phase(tables.atmosphere.rayleigh.depolarisation, nu);
  const double mie_phase = aerosol_phase(tables.atmosphere.mie.phase, nu);
  const double length_km =
      1e-3 * (hits_ground ? shared.distance_to_inner_sphere(p.bottom, height, mu, 0.0)
                          : shared.distance_to_outer_sphere(p.bottom, height, mu, p.thickness));
  NodeValues sum;
  for (std::size_t k = 0; k < 4; ++k)
    sum[k] = length_km * (std::exp(rayleigh[k]) * rayleigh_phase + std::exp(mie[k]) * mie_phase);
  return sum;
}

}  // namespace skyfit
