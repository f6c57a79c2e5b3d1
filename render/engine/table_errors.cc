// SPDX-License-Identifier: Apache-2.0
#include "render/engine/table_errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "model/tables/table_lookup.h"
#include "render/page/page_errors.h"

namespace skyfit {
namespace {

constexpr std::array kTwilightSuns_deg = {90.0, 92.0, 94.0, 96.0};

std::vector<double> sky(const AtmosphereTables& tables, std::span<const double> suns_deg) {
  return table_luminances(tables, {}, tables.phases, compared_points(0, suns_deg));
}

double luminance(const AtmosphereTables& tables, const NodeValues& light) {
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) sum += tables.color.xyz_from_nodes[1][k] * light[k];
  return sum;
}

double in_scatter(const AtmosphereTables& tables, const TablePlace& eye, double nu,
                  double distance) {
  const TablePlace end = place_along(tables, eye, nu, distance);
  const NodeValues through = lookup_transmittance(tables, eye, end, false),
                   whole = lookup_radiance(tables, eye.height, eye.mu, eye.mu_s, nu, false),
                   rest = lookup_radiance(tables, end.height, end.mu, end.mu_s, nu, false);
  NodeValues before;
  for (std::size_t k = 0; k < 4; ++k) before[k] = std::max(whole[k] - through[k] * rest[k], 0.0);
  return luminance(tables, before);
}

std::vector<double> in_scatters(const AtmosphereTables& tables) {
  constexpr double kDegree = std::numbers::pi / 180, kEye = 2;  // m
  std::vector<double> values;
  for (const double sun : kDaySuns_deg) {
    for (const double view : {60.0, 80.0, 88.0, 89.9}) {
      for (const double azimuth : {0.0, 60.0, 180.0}) {
        const double mu = std::cos(view * kDegree), mu_s = std::cos(sun * kDegree);
        const double nu = mu * mu_s + std::sin(view * kDegree) * std::sin(sun * kDegree) *
                                          std::cos(azimuth * kDegree);
        for (const double distance : {2e3, 20e3})
          values.push_back(in_scatter(tables, {kEye, mu, mu_s}, nu, distance));
      }
    }
  }
  return values;
}

}  // namespace

LuminanceError luminance_error(std::span<const double> values, std::span<const double> truth) {
  LuminanceError error;
  double squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (!(truth[i] > 0)) continue;
    const double off = std::abs(values[i] / truth[i] - 1);
    squares += off * off;
    error.worst = std::max(error.worst, off);
    ++error.compared;
  }
  if (error.compared > 0) error.rms = std::sqrt(squares / static_cast<double>(error.compared));
  return error;
}

TableErrors errors_against_tables(const AtmosphereTables& tables, const AtmosphereTables& truth) {
  return {luminance_error(sky(tables, kDaySuns_deg), sky(truth, kDaySuns_deg)),
          luminance_error(sky(tables, kTwilightSuns_deg), sky(truth, kTwilightSuns_deg)),
          luminance_error(in_scatters(tables), in_scatters(truth))};
}

TableErrors errors_against_reference(const AtmosphereTables& tables, const SpectralData& spectra,
                                     int threads) {
  const auto error = [&](std::span<const double> suns_deg) {
    return luminance_error(
        sky(tables, suns_deg),
        reference_luminances(tables.atmosphere, spectra, compared_points(0, suns_deg), threads));
  };
  return {error(kDaySuns_deg), error(kTwilightSuns_deg), {}};
}

}  // namespace skyfit
