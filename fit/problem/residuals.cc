// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/residuals.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace skyfit::fit {
namespace {

void check_positive(const Luminance& luminance, std::span<const SkyPoint> points) {
  constexpr double kDegrees = 180 / std::numbers::pi;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double value = luminance.value(static_cast<Eigen::Index>(i));
    if (value > 0 && std::isfinite(value)) continue;
    throw std::domain_error(fmt::format(
        "fit: the model's luminance at sun zenith {:.6g} deg, view zenith {:.6g} deg, azimuth "
        "{:.6g} deg is {:.6g} cd/m^2: must be > 0 for a logarithmic residual",
        points[i].sun_zenith * kDegrees, points[i].view_zenith * kDegrees,
        points[i].relative_azimuth * kDegrees, value));
  }
}

}  // namespace

LuminanceRule rule_of(const refs::Reference& reference, const SpectralData& spectra, bool coarse) {
  if (reference.quantity != refs::Quantity::kSpectralRadiance)
    return coarse ? coarse_luminance_rule(spectra) : luminance_rule(spectra);
  const double wavelength = reference.samples.empty() ? 0 : reference.samples[0].wavelength_nm;
  for (const refs::Sample& sample : reference.samples) {
    if (sample.wavelength_nm == wavelength) continue;
    throw std::invalid_argument(
        fmt::format("{}: samples at {:.9g} and {:.9g} nm: must be of one wavelength",
                    reference.name, wavelength, sample.wavelength_nm));
  }
  return {spectral_nodes(spectra, {wavelength}), {spectra.solar_irradiance.at(wavelength)}};
}

Luminance model_luminance(const SkyModel& model, const LuminanceRule& rule,
                          const Atmosphere<double>& atmosphere, std::span<const SkyPoint> points,
                          std::span<const Parameter> derivatives) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const SkyValues sky = model.radiance(atmosphere, rule.nodes, points, derivatives);
  const Eigen::Index count = static_cast<Eigen::Index>(points.size());
  const Eigen::Index nodes = static_cast<Eigen::Index>(rule.nodes.size());
  const Eigen::Map<const Eigen::VectorXd> weight(rule.weight.data(), nodes);
  Luminance result;
  result.value = Eigen::Map<const Rows>(sky.value.data(), count, nodes) * weight;
  result.derivative.resize(count, static_cast<Eigen::Index>(derivatives.size()));
  for (Eigen::Index p = 0; p < result.derivative.cols(); ++p) {
    const double* slab = sky.derivative.data() + p * count * nodes;
    result.derivative.col(p) = Eigen::Map<const Rows>(slab, count, nodes) * weight;
  }
  return result;
}

Luminance select(const Luminance& luminance, const Observations& observations) {
  Luminance result;
  result.value = luminance.value(observations.sample);
  result.derivative = luminance.derivative(observations.sample, Eigen::all);
  return result;
}

// docs/theory (11.2) and (11.3).
LogResiduals log_residuals(const Observations& observations, const Luminance& luminance) {
  check_positive(luminance, observations.points);
  const Eigen::VectorXd whitening =
      observations.weight.cwiseSqrt().cwiseQuotient(observations.sigma_log);
  const Eigen::VectorXd weight = whitening.cwiseAbs2();
  LogResiduals result;
  result.residual = luminance.value.array().log().matrix() - observations.log_reference;
  result.log_scale =
      -subtract_scan_means(observations.scan, observations.scans, weight, result.residual);
  result.residual.array() *= whitening.array();
  result.jacobian = luminance.value.cwiseInverse().asDiagonal() * luminance.derivative;
  subtract_scan_means(observations.scan, observations.scans, weight, result.jacobian);
  result.jacobian = whitening.asDiagonal() * result.jacobian;
  return result;
}

}  // namespace skyfit::fit
