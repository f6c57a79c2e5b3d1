// SPDX-License-Identifier: Apache-2.0
#include "model/solver/single_scattering.h"

#include <algorithm>
#include <cmath>

#include "model/atmosphere/column_kernels.h"
#include "model/atmosphere/parameter_field.h"

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

// Of one profile, from points upward to the top; mu as for exponential_column().
std::vector<std::vector<double>> columns_to_top(const Shells& shells, const Profile& profile,
                                                const std::vector<double>& height,
                                                const std::vector<double>& mu, bool derivatives) {
  const kernels::Sphere sphere{shells.bottom_radius, shells.top};
  const auto linear = [&](const LinearProfile& table) {
    std::vector<double> column(height.size());
    kernels::linear_columns(sphere, table, height.size(), height.data(), mu.data(), column.data());
    return column;
  };
  if (!profile.is_exponential()) {
    std::vector<std::vector<double>> c = {linear(profile.table())};
    for (std::size_t s = 0; derivatives && s < profile.shapes(); ++s)
      c.push_back(linear(profile.table_by_shape(s)));
    return c;
  }
  std::vector<std::vector<double>> c(2, std::vector<double>(height.size()));
  kernels::exponential_columns(sphere, profile.scale_height(), height.size(), height.data(),
                               mu.data(), c[0].data(), c[1].data());
  return c;
}

ColumnArrays columns_to_top(const Shells& shells, const std::vector<double>& height,
                            const std::vector<double>& mu, bool derivatives) {
  ColumnArrays c;
  for (const Profile& profile : shells.profiles)
    c.push_back(columns_to_top(shells, profile, height, mu, derivatives));
  return c;
}

double part_of(const Column& c, std::size_t part) {
  return part == 0 ? c.value : c.by_shape[part - 1];
}

// Columns from the entry: as columns_along() of model/geometry/ray.h for each node.
ColumnArrays columns_from_entry(const Shells& shells, const ViewRay& ray, const RayNodes& nodes,
                                bool derivatives) {
  std::vector<double> mu;
  for (const RayPoint& p : nodes.points) {
    const bool descends = p.s < ray.tangent_s;
    mu.push_back(std::max(descends ? -p.mu : p.mu, 0.0));
  }
  ColumnArrays c = columns_to_top(shells, nodes.height, mu, derivatives);
  const bool entry_descends = ray.tangent_s > 0;
  const PathColumns from_entry = shells.columns_to_top(ray.entry_height, std::abs(ray.entry_mu));
  PathColumns from_lowest;
  if (entry_descends && !ray.hits_ground)
    from_lowest = shells.columns_to_top(ray.tangent_height, 0);
  for (std::size_t k = 0; k < c.size(); ++k) {
    for (std::size_t part = 0; part < c[k].size(); ++part) {
      const double entry = part_of(from_entry[k], part), lowest = part_of(from_lowest[k], part);
      for (std::size_t i = 0; i < mu.size(); ++i) {
        double& x = c[k][part][i];
        if (!entry_descends) {
          x = entry - x;
        } else if (nodes.points[i].s < ray.tangent_s) {
          x -= entry;
        } else {
          x = 2 * lowest - entry - x;
        }
      }
    }
  }
  return c;
}

// The density at the heights and its derivatives by the shape.
std::vector<std::vector<double>> densities(const Profile& profile,
                                           const std::vector<double>& height, bool derivatives) {
  std::vector<std::vector<double>> rho(1, std::vector<double>(height.size()));
  if (profile.is_exponential()) {
    const double scale_height = profile.scale_height();
    kernels::exponential_densities(scale_height, height.size(), height.data(), rho[0].data());
    if (!derivatives) return rho;
    rho.emplace_back(height.size());
    for (std::size_t i = 0; i < height.size(); ++i)
      rho[1][i] = rho[0][i] * height[i] / (scale_height * scale_height);
    return rho;
  }
  const auto at_heights = [&](const LinearProfile& table, std::vector<double>& out) {
    std::ranges::transform(height, out.begin(), [&](double h) { return table.density(h); });
  };
  at_heights(profile.table(), rho[0]);
  for (std::size_t s = 0; derivatives && s < profile.shapes(); ++s)
    at_heights(profile.table_by_shape(s), rho.emplace_back(height.size()));
  return rho;
}

}  // namespace

RayNodes ray_nodes(const Shells& shells, const std::vector<char>& scattering, const ViewRay& ray,
                   const std::vector<double>& edges, bool derivatives) {
  std::vector<double> breaks = with_short_pieces(
      shell_crossings(ray, shells.bottom_radius, shell_heights(shells.top)), shells.bottom_radius);
  breaks.insert(breaks.end(), edges.begin(), edges.end());
  RayNodes nodes;
  breaks = with_piece_breaks(with_profile_breaks(shells, ray, breaks));
  for (const QuadratureNode& q : composite_gauss(breaks, kOrder)) {
    nodes.points.push_back(ray_point(ray, shells.bottom_radius, q.s));
    nodes.weight.push_back(q.weight);
    nodes.height.push_back(nodes.points.back().height);
  }
  for (std::size_t i = 0; i < shells.profiles.size(); ++i) {
    nodes.density.emplace_back();
    if (scattering[i])
      nodes.density.back() = densities(shells.profiles[i], nodes.height, derivatives);
  }
  nodes.columns = columns_from_entry(shells, ray, nodes, derivatives);
  return nodes;
}

SunlitNodes sunlit_nodes(const Shells& shells, const RayNodes& nodes, const SunAlongRay& sun) {
  SunlitNodes result;
  result.weight = nodes.weight;
  std::vector<double> mu_s;
  for (std::size_t i = 0; i < nodes.points.size(); ++i) {
    const RayPoint& p = nodes.points[i];
    mu_s.push_back(sun.mu_s(p));
    result.nu.push_back(sun.nu(p, mu_s.back()));
    if (sun.lit(p, mu_s.back())) {
      result.weight[i] *= sun.beam_spread(p, mu_s.back());
      continue;
    }
    result.weight[i] = 0;
    mu_s.back() = 1;  // any that has a column
  }
  for (std::size_t k = 0; k < shells.profiles.size(); ++k) {
    const std::vector<std::vector<double>>& along = nodes.columns[k];
    result.columns.push_back(
        columns_to_top(shells, shells.profiles[k], nodes.height, mu_s, along.size() > 1));
    for (std::size_t part = 0; part < along.size(); ++part) {
      for (std::size_t i = 0; i < mu_s.size(); ++i) result.columns[k][part][i] += along[part][i];
    }
  }
  return result;
}

template <int N>
std::vector<Dual<N>> single_scattering(const Optics<N>& optics, const RayNodes& nodes,
                                       const SunlitNodes& sunlit, const PhaseAtNodes<N>& phase) {
  const std::size_t count = nodes.points.size(), profiles = optics.profiles.size();
  std::vector<const double*> columns;
  std::vector<double> extinction;
  for (std::size_t k = 0; k < profiles; ++k) {
    columns.push_back(sunlit.columns[k].front().data());
    extinction.push_back(optics.scaled_extinction[k].v);
  }
  std::vector<double> through(count), scattered(count);
  kernels::weighted_transmittances(count, sunlit.weight.data(), profiles, columns.data(),
                                   extinction.data(), through.data());
  std::vector<Dual<N>> light;
  const std::vector<double> without_phase = through;
  for (std::size_t k = 0; k < optics.scatterers.size(); ++k) {
    const Scatterer<N>& scatterer = optics.scatterers[k];
    const std::vector<std::vector<double>>& density = nodes.density[scatterer.profile];
    for (std::size_t i = 0; !phase.empty() && i < count; ++i)
      through[i] = without_phase[i] * phase[k][i].v;
    // docs/theory (8.2) and (8.3).
    // Sum over the ray of rho T ds; d T = -T d tau, tau = sum of extinction times column.
    Dual<N> sum(
        kernels::product_and_sum(count, through.data(), density[0].data(), scattered.data()));
    if constexpr (N > 0) {
      const auto add = [&](double factor, const Dual<N>& by) {
        for (std::size_t p = 0; p < N; ++p) sum.d[p] += factor * by.d[p];
      };
      for (std::size_t s = 0; s < optics.profiles[scatterer.profile].shapes(); ++s)
        add(kernels::dot(count, through.data(), density[1 + s].data()),
            optics.shape[scatterer.profile][s]);
      for (std::size_t q = 0; q < profiles; ++q) {
        add(-kernels::dot(count, scattered.data(), columns[q]), optics.scaled_extinction[q]);
        for (std::size_t s = 0; s < optics.profiles[q].shapes(); ++s)
          add(-extinction[q] *
                  kernels::dot(count, scattered.data(), sunlit.columns[q][1 + s].data()),
              optics.shape[q][s]);
      }
      for (std::size_t i = 0; !phase.empty() && i < count; ++i)
        add(without_phase[i] * density[0][i], phase[k][i]);
    }
    light.push_back(scatterer.scattering * sum);
  }
  return light;
}

template std::vector<Dual<0>> single_scattering<0>(const Optics<0>&, const RayNodes&,
                                                   const SunlitNodes&, const PhaseAtNodes<0>&);
template std::vector<Dual<kDerivativesAtOnce>> single_scattering<kDerivativesAtOnce>(
    const Optics<kDerivativesAtOnce>&, const RayNodes&, const SunlitNodes&,
    const PhaseAtNodes<kDerivativesAtOnce>&);

}  // namespace skyfit
