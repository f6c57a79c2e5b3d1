// SPDX-License-Identifier: Apache-2.0
#include "model/solver/single_scattering.h"

#include <algorithm>
#include <cmath>

#include "model/atmosphere/column_kernels.h"
#include "model/atmosphere/parameters.h"

namespace skyfit {
namespace {

constexpr int kOrder = 3;  // nodes between shells

// Heights between which every profile and its extinction are smooth enough for the rule: dense
// where an aerosol of the least scale height lives, with the corners of the ozone tent. Profiles
// from tables bring their own besides.
std::vector<double> shell_heights(double top) {
  std::vector<double> heights = {60,    150,   300,   500,   800,   1200,  1700,  2400,
                                 3300,  4500,  6000,  8000,  10000, 13000, 17000, 21000,
                                 25000, 32000, 40000, 52000, 68000, 84000};
  constexpr double kStep = 1.25;
  while (heights.back() * kStep < top) heights.push_back(heights.back() * kStep);
  return heights;
}

// Between high shells a ray along the limb is long: no piece lets the sun's height change by more
// than a degree, over which it may rise through all the air below.
std::vector<double> with_short_pieces(const std::vector<double>& breaks, double bottom_radius) {
  const double longest = 0.0175 * bottom_radius;
  std::vector<double> pieces = {breaks.front()};
  for (std::size_t i = 1; i < breaks.size(); ++i) {
    const double length = breaks[i] - breaks[i - 1], count = std::ceil(length / longest);
    for (double k = 1; k < count; ++k) pieces.push_back(breaks[i - 1] + length * k / count);
    pieces.push_back(breaks[i]);
  }
  return pieces;
}

void set_columns(const Shells& shells, const Profile& profile, const std::vector<double>& height,
                 const std::vector<double>& mu, std::vector<double>& value,
                 std::vector<double>& by_scale_height) {
  const kernels::Sphere sphere{shells.bottom_radius, shells.top};
  value.resize(height.size());
  by_scale_height.assign(height.size(), 0.0);
  if (profile.is_exponential()) {
    kernels::exponential_columns(sphere, profile.scale_height(), height.size(), height.data(),
                                 mu.data(), value.data(), by_scale_height.data());
  } else {
    kernels::linear_columns(sphere, profile.table(), height.size(), height.data(), mu.data(),
                            value.data());
  }
}

// From points upward to the top; mu as for exponential_column().
ColumnArrays columns_to_top(const Shells& shells, const std::vector<double>& height,
                            const std::vector<double>& mu) {
  ColumnArrays c;
  set_columns(shells, shells.profiles.air, height, mu, c[0], c[3]);
  set_columns(shells, shells.profiles.aerosol, height, mu, c[1], c[4]);
  if (!shells.ozone) {
    c[2].assign(height.size(), 0.0);
    c[5] = c[2];
  } else if (shells.profiles.ozone == shells.profiles.air) {
    c[2] = c[0];
    c[5] = c[3];
  } else {
    set_columns(shells, shells.profiles.ozone, height, mu, c[2], c[5]);
  }
  return c;
}

std::array<double, 6> as_array(const PathColumns& c) {
  return {c.air.value,           c.aerosol.value,           c.ozone.value,
          c.air.by_scale_height, c.aerosol.by_scale_height, c.ozone.by_scale_height};
}

// Columns from the entry: as columns_along() of model/geometry/ray.h for each node.
ColumnArrays columns_from_entry(const Shells& shells, const ViewRay& ray, const RayNodes& nodes) {
  std::vector<double> mu;
  for (const RayPoint& p : nodes.points) {
    const bool descends = p.s < ray.tangent_s;
    mu.push_back(std::max(descends ? -p.mu : p.mu, 0.0));
  }
  ColumnArrays c = columns_to_top(shells, nodes.height, mu);
  const bool entry_descends = ray.tangent_s > 0;
  const std::array<double, 6> entry =
      as_array(shells.columns_to_top(ray.entry_height, std::abs(ray.entry_mu)));
  std::array<double, 6> lowest{};
  if (entry_descends && !ray.hits_ground)
    lowest = as_array(shells.columns_to_top(ray.tangent_height, 0));
  for (std::size_t k = 0; k < c.size(); ++k) {
    for (std::size_t i = 0; i < mu.size(); ++i) {
      double& x = c[k][i];
      if (!entry_descends) {
        x = entry[k] - x;
      } else if (nodes.points[i].s < ray.tangent_s) {
        x -= entry[k];
      } else {
        x = 2 * lowest[k] - entry[k] - x;
      }
    }
  }
  return c;
}

std::vector<double> densities(const Profile& profile, const std::vector<double>& height) {
  std::vector<double> rho(height.size());
  if (profile.is_exponential()) {
    kernels::exponential_densities(profile.scale_height(), height.size(), height.data(),
                                   rho.data());
  } else {
    std::ranges::transform(height, rho.begin(),
                           [&](double h) { return profile.table().density(h); });
  }
  return rho;
}

}  // namespace

RayNodes ray_nodes(const Shells& shells, const ViewRay& ray, const std::vector<double>& edges) {
  std::vector<double> breaks = with_short_pieces(
      shell_crossings(ray, shells.bottom_radius, shell_heights(shells.top)), shells.bottom_radius);
  breaks.insert(breaks.end(), edges.begin(), edges.end());
  RayNodes nodes;
  breaks = with_piece_breaks(with_table_breaks(shells, ray, breaks));
  for (const QuadratureNode& q : composite_gauss(breaks, kOrder)) {
    nodes.points.push_back(ray_point(ray, shells.bottom_radius, q.s));
    nodes.weight.push_back(q.weight);
    nodes.height.push_back(nodes.points.back().height);
  }
  nodes.density = {densities(shells.profiles.air, nodes.height),
                   densities(shells.profiles.aerosol, nodes.height)};
  nodes.columns = columns_from_entry(shells, ray, nodes);
  return nodes;
}

SunlitNodes sunlit_nodes(const Shells& shells, const RayNodes& nodes, const SunAlongRay& sun) {
  SunlitNodes result;
  result.weight = nodes.weight;
  std::vector<double> mu_s;
  for (std::size_t i = 0; i < nodes.points.size(); ++i) {
    mu_s.push_back(sun.mu_s(nodes.points[i]));
    if (sun.lit(nodes.points[i], mu_s.back())) continue;
    result.weight[i] = 0;
    mu_s.back() = 1;  // any that has a column
  }
  result.columns = columns_to_top(shells, nodes.height, mu_s);
  for (std::size_t k = 0; k < result.columns.size(); ++k) {
    for (std::size_t i = 0; i < mu_s.size(); ++i) result.columns[k][i] += nodes.columns[k][i];
  }
  return result;
}

template <int N>
SingleScattering<N> single_scattering(const Optics<N>& optics, const RayNodes& nodes,
                                      const SunlitNodes& sunlit) {
  const double* const density[2] = {nodes.density[0].data(), nodes.density[1].data()};
  const double* columns[6];
  for (std::size_t k = 0; k < 6; ++k) columns[k] = sunlit.columns[k].data();
  const double extinction[3] = {optics.air.v, optics.aerosol_extinction.v, optics.ozone.v};
  kernels::RaySums sums[2];
  kernels::ray_sums(nodes.points.size(), sunlit.weight.data(), nodes.height.data(), density,
                    columns, extinction, sums);
  // Sum over the ray of rho T ds; d T = -T d tau, tau = sum of extinction times column.
  const auto dual = [&](const kernels::RaySums& s, const Profile& profile,
                        const Dual<N>& scale_height) {
    Dual<N> sum(s.plain);
    const double by_air_height = optics.air.v * s.by_column[3] + optics.ozone.v * s.by_column[5];
    const double by_aerosol_height = optics.aerosol_extinction.v * s.by_column[4];
    const double by_own_height =
        profile.is_exponential() ? s.by_height / (scale_height.v * scale_height.v) : 0;
    for (std::size_t p = 0; p < N; ++p) {
      sum.d[p] = by_own_height * scale_height.d[p] - optics.air.d[p] * s.by_column[0] -
                 optics.aerosol_extinction.d[p] * s.by_column[1] -
                 optics.ozone.d[p] * s.by_column[2] - optics.air_scale_height.d[p] * by_air_height -
                 optics.aerosol_scale_height.d[p] * by_aerosol_height;
    }
    return sum;
  };
  return {optics.air * dual(sums[0], optics.profiles.air, optics.air_scale_height),
          optics.aerosol_scattering *
              dual(sums[1], optics.profiles.aerosol, optics.aerosol_scale_height)};
}

template SingleScattering<0> single_scattering<0>(const Optics<0>&, const RayNodes&,
                                                  const SunlitNodes&);
template SingleScattering<kParameterCount> single_scattering<kParameterCount>(
    const Optics<kParameterCount>&, const RayNodes&, const SunlitNodes&);

}  // namespace skyfit
