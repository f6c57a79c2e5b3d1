// SPDX-License-Identifier: Apache-2.0
#include "render/page/page_errors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/solver/reference_model.h"

namespace skyfit {

std::vector<SkyPoint> compared_points(double altitude_m, std::span<const double> suns_deg) {
  constexpr double kDegree = std::numbers::pi / 180;
  std::vector<SkyPoint> points;
  for (const double sun : suns_deg) {
    for (const double view : {5.0, 15.0, 30.0, 45.0, 60.0, 75.0, 80.0, 85.0, 89.0}) {
      for (const double azimuth :
           {0.0, 4.0, 8.0, 12.0, 20.0, 40.0, 60.0, 90.0, 120.0, 150.0, 170.0, 180.0})
        points.push_back({altitude_m, sun * kDegree, view * kDegree, azimuth * kDegree});
    }
  }
  return points;
}

std::vector<double> reference_luminances(const Atmosphere<double>& atmosphere,
                                         const SpectralData& spectra,
                                         std::span<const SkyPoint> points, int threads) {
  ReferenceOptions options;
  options.threads = threads;
  const LuminanceRule rule = luminance_rule(spectra);
  const SkyValues sky = ReferenceModel(options).radiance(atmosphere, rule.nodes, points, {});
  std::vector<double> luminances;
  for (int p = 0; p < sky.points; ++p) {
    double sum = 0;
    for (int k = 0; k < sky.wavelengths; ++k)
      sum += rule.weight[static_cast<std::size_t>(k)] * sky.at(p, k);
    luminances.push_back(sum);
  }
  return luminances;
}

std::vector<double> table_luminances(const AtmosphereTables& tables,
                                     std::span<const WeightedTables> changes,
                                     const PhaseClasses& phases, std::span<const SkyPoint> points) {
  std::vector<double> luminances;
  for (const SkyPoint& p : points) {
    const double mu = std::cos(p.view_zenith), mu_s = std::cos(p.sun_zenith);
    const double nu =
        mu * mu_s + std::sin(p.view_zenith) * std::sin(p.sun_zenith) * std::cos(p.relative_azimuth);
    const NodeValues light =
        lookup_changed_radiance(tables, changes, phases, {p.altitude_m, mu, mu_s}, nu, false);
    double sum = 0;
    for (std::size_t k = 0; k < 4; ++k) sum += tables.color.xyz_from_nodes[1][k] * light[k];
    luminances.push_back(sum);
  }
  return luminances;
}

WorstError largest_error(std::span<const SkyPoint> points, std::span<const double> a,
                         std::span<const double> b) {
  WorstError worst;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double error = std::abs(a[i] / b[i] - 1);
    if (error >= worst.error) worst = {error, points[i]};
  }
  return worst;
}

}  // namespace skyfit
