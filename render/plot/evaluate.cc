// SPDX-License-Identifier: Apache-2.0
#include "render/plot/evaluate.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>

#include "model/numerics/angles.h"

namespace skyfit::plot {
namespace {

// Sheds the noise of the way through radians: 5 degrees read 5 again, not 5.000000000000001.
double degrees(double radians) {
  constexpr double kDigits = 1e10;
  return std::round(radians * kDegreesPerRadian * kDigits) / kDigits;
}

double counted_weight(const refs::Sample& sample, double exclude_sun) {
  constexpr double kRounding = 1e-9;  // radians: a sample on the rim of the cone counts
  return refs::scattering_angle(sample) < exclude_sun - kRounding ? 0.0 : sample.weight;
}

void expect_one_per_sample(std::span<const double> values, std::size_t samples, const char* name) {
  if (values.size() != samples)
    throw std::invalid_argument(
        fmt::format("{}: {} values: expected {}, one per sample", name, values.size(), samples));
}

std::vector<double> luminances(const refs::Reference& reference,
                               const Atmosphere<double>& atmosphere, const SpectralData& spectra,
                               const SkyModel& model) {
  const LuminanceRule rule = luminance_rule(spectra);
  std::vector<SkyPoint> points;
  for (const auto& sample : reference.samples)
    points.push_back({0, sample.sun_zenith, sample.view_zenith, sample.relative_azimuth});
  const SkyValues values = model.radiance(atmosphere, rule.nodes, points, {});
  std::vector<double> luminance(points.size(), 0);
  for (int point = 0; point < values.points; ++point)
    for (int node = 0; node < values.wavelengths; ++node)
      luminance[point] += rule.weight[node] * values.at(point, node);
  return luminance;
}

// exp of the weighted mean of ln(reference / model) over the sample's scan.
std::vector<double> scales(const refs::Reference& reference, const std::vector<double>& luminance,
                           double exclude_sun) {
  struct Mean {
    double sum = 0, weight = 0;
  };
  std::map<int, Mean> scans;
  for (std::size_t i = 0; i < luminance.size(); ++i) {
    const auto& sample = reference.samples[i];
    const double weight = counted_weight(sample, exclude_sun);
    scans[sample.scan].sum += weight == 0 ? 0 : weight * std::log(sample.value / luminance[i]);
    scans[sample.scan].weight += weight;
  }
  std::vector<double> scale;
  for (const auto& sample : reference.samples)
    scale.push_back(std::exp(scans[sample.scan].sum / scans[sample.scan].weight));
  return scale;
}

}  // namespace

std::vector<Sample> compared_samples(const refs::Reference& reference,
                                     std::span<const double> model,
                                     std::span<const double> start_model, double exclude_sun) {
  const std::size_t count = reference.samples.size();
  const bool with_start = !start_model.empty();
  expect_one_per_sample(model, count, "fitted model");
  if (with_start) expect_one_per_sample(start_model, count, "start model");
  std::vector<Sample> compared;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& sample = reference.samples[i];
    if (std::isnan(model[i]) || !(sample.value > 0)) continue;
    Sample row;
    row.scan = sample.scan + 1;
    row.sun_zenith_deg = degrees(sample.sun_zenith);
    row.view_zenith_deg = degrees(sample.view_zenith);
    row.relative_azimuth_deg = degrees(sample.relative_azimuth);
    row.wavelength_nm = sample.wavelength_nm;
    row.reference = sample.value;
    row.model = model[i];
    row.weight = counted_weight(sample, exclude_sun);
    if (with_start) row.start_model = start_model[i];
    compared.push_back(row);
  }
  return compared;
}

std::vector<Sample> evaluated_samples(const refs::Reference& reference,
                                      const Atmosphere<double>& atmosphere,
                                      const SpectralData& spectra, const SkyModel& model,
                                      double exclude_sun) {
  std::vector<double> luminance = luminances(reference, atmosphere, spectra, model);
  const auto scale = scales(reference, luminance, exclude_sun);
  for (std::size_t i = 0; i < luminance.size(); ++i) luminance[i] *= scale[i];
  return compared_samples(reference, luminance, {}, exclude_sun);
}

}  // namespace skyfit::plot
