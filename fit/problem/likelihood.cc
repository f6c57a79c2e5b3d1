// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/likelihood.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

std::vector<int> scans_of_samples(const Dataset& data) {
  std::vector<int> scans;
  scans.reserve(data.samples.size());
  for (const Sample& sample : data.samples) scans.push_back(data.scan_of(sample));
  return scans;
}

void require_positive(const Dataset& data, const Eigen::VectorXd& model) {
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    const double value = model(static_cast<Eigen::Index>(i));
    if (value > 0 && std::isfinite(value)) continue;
    const Sample& sample = data.samples[i];
    const SkyPoint& at = data.views[static_cast<std::size_t>(sample.view)].stated;
    const double nm = data.channels[static_cast<std::size_t>(sample.channel)].wavelength_nm;
    throw std::domain_error(fmt::format(
        "fit: the model at sun zenith {:.6g} deg, view zenith {:.6g} deg, azimuth {:.6g} deg is "
        "{:.6g} {}: must be > 0 for a logarithmic residual",
        at.sun_zenith * kDegreesPerRadian, at.view_zenith * kDegreesPerRadian,
        at.relative_azimuth * kDegreesPerRadian, value,
        nm > 0              ? fmt::format("W m^-2 sr^-1 nm^-1 at {:.6g} nm", nm)
        : sample.irradiance ? fmt::format("({})", kIrradianceNames[*sample.irradiance])
                            : "cd/m^2"));
  }
}

// Logarithms and their derivatives; sigma becomes relative.
void take_logarithms(const Dataset& data, Whitened& white, Eigen::VectorXd& sigma,
                     Eigen::VectorXd& value) {
  require_positive(data, white.residual);
  white.jacobian_per_unit = white.residual.cwiseInverse().asDiagonal() * white.jacobian_per_unit;
  white.residual = white.residual.array().log();
  sigma = sigma.cwiseQuotient(value);
  value = value.array().log();
}

// docs/theory (11.2) and (11.3).
void profile_log_scale(const std::vector<int>& scan, const Eigen::VectorXd& weight,
                       Whitened& white) {
  const int scans = static_cast<int>(white.scale.size());
  white.scale = (-subtract_scan_means(scan, scans, weight, white.residual).col(0)).array().exp();
  subtract_scan_means(scan, scans, weight, white.jacobian_per_unit);
}

// c = sum(w m y) / sum(w m^2) of a scan, c' = sum(w m' (y - 2 c m)) / sum(w m^2); the model m and
// its derivatives become c m and c m' + c' m.
void profile_linear_scale(const std::vector<int>& scan, const Eigen::VectorXd& weight,
                          const Eigen::VectorXd& value, Eigen::VectorXd& model, Whitened& white) {
  const Eigen::Index scans = white.scale.size(), unknowns = white.jacobian_per_unit.cols();
  Eigen::VectorXd products = Eigen::VectorXd::Zero(scans), squares = products;
  for (Eigen::Index i = 0; i < model.size(); ++i) {
    products(scan[i]) += weight(i) * model(i) * value(i);
    squares(scan[i]) += weight(i) * model(i) * model(i);
  }
  white.scale = products.cwiseQuotient(squares);
  Eigen::MatrixXd derivative = Eigen::MatrixXd::Zero(scans, unknowns);
  for (Eigen::Index i = 0; i < model.size(); ++i) {
    derivative.row(scan[i]) += weight(i) * (value(i) - 2 * white.scale(scan[i]) * model(i)) /
                               squares(scan[i]) * white.jacobian_per_unit.row(i);
  }
  for (Eigen::Index i = 0; i < model.size(); ++i) {
    white.jacobian_per_unit.row(i) *= white.scale(scan[i]);
    white.jacobian_per_unit.row(i) += model(i) * derivative.row(scan[i]);
    model(i) *= white.scale(scan[i]);
  }
}

// docs/theory (11.4).
Whitened whiten_radiances(const Dataset& data, const Likelihood& likelihood,
                          const SampleValues& values, double factor) {
  const auto count = static_cast<Eigen::Index>(data.samples.size());
  Eigen::VectorXd sigma(count), value(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    sigma(i) = data.samples[static_cast<std::size_t>(i)].sigma;
    value(i) = data.samples[static_cast<std::size_t>(i)].value;
  }
  Whitened white{values.value, values.derivative,
                 Eigen::VectorXd::Ones(static_cast<Eigen::Index>(data.scans.size()))};
  if (likelihood.link == Link::kLog) take_logarithms(data, white, sigma, value);
  const Eigen::VectorXd weight = sigma.cwiseAbs2().cwiseInverse();
  const bool profiled = likelihood.scale == Scale::kProfiled;
  if (profiled && likelihood.link == Link::kLinear)
    profile_linear_scale(scans_of_samples(data), weight, value, white.residual, white);
  white.residual -= value;
  if (profiled && likelihood.link == Link::kLog)
    profile_log_scale(scans_of_samples(data), weight, white);
  const Eigen::VectorXd inverse = (factor * sigma).cwiseInverse();
  white.residual = white.residual.cwiseProduct(inverse);
  white.jacobian_per_unit = inverse.asDiagonal() * white.jacobian_per_unit;
  return white;
}

}  // namespace

std::string_view link_name(Link link) { return link == Link::kLog ? "log" : "linear"; }

std::string_view scale_name(Scale scale) {
  switch (scale) {
    case Scale::kFixed:
      return "fixed";
    case Scale::kShared:
      return "shared";
    case Scale::kPerScan:
      return "per-scan";
    case Scale::kProfiled:
      break;
  }
  return "profiled";
}

Link default_link(refs::Quantity quantity) {
  return quantity == refs::Quantity::kRelativeLuminance || refs::is_irradiance(quantity)
             ? Link::kLog
             : Link::kLinear;
}

Scale default_scale(refs::Quantity quantity) {
  return quantity == refs::Quantity::kRelativeLuminance ? Scale::kProfiled : Scale::kFixed;
}

Whitened whiten(const Dataset& data, const Likelihood& likelihood, const SampleValues& values,
                double factor) {
  const std::vector<int> readings = polarisations(data);
  const std::vector<int> irradiances = irradiances_beside_sky(data);
  if (readings.empty() && irradiances.empty())
    return whiten_radiances(data, likelihood, values, factor);
  const std::vector<int> others = radiances(data);
  const Whitened of_radiances =
      whiten_radiances(only_samples(data, others), likelihood,
                       {values.value(others), values.derivative(others, Eigen::all)}, factor);
  Whitened white{values.value, values.derivative, of_radiances.scale};
  const auto take = [&](const std::vector<int>& indices, const Whitened& of) {
    white.residual(indices) = of.residual;
    white.jacobian_per_unit(indices, Eigen::all) = of.jacobian_per_unit;
  };
  take(others, of_radiances);
  take(
      irradiances,
      whiten_radiances(only_samples(data, irradiances), {Link::kLog, Scale::kFixed, {}},
                       {values.value(irradiances), values.derivative(irradiances, Eigen::all)}, 1));
  for (const int i : readings) {
    const Sample& reading = data.samples[static_cast<std::size_t>(i)];
    const double sigma = factor * reading.sigma;
    white.residual(i) = (values.value(i) - reading.value) / sigma;
    white.jacobian_per_unit.row(i) = values.derivative.row(i) / sigma;
  }
  return white;
}

Eigen::MatrixXd subtract_scan_means(const std::vector<int>& scan, int scans,
                                    const Eigen::VectorXd& weight,
                                    Eigen::Ref<Eigen::MatrixXd> columns) {
  Eigen::MatrixXd means = Eigen::MatrixXd::Zero(scans, columns.cols());
  Eigen::VectorXd sums = Eigen::VectorXd::Zero(scans);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) {
    means.row(scan[i]) += weight(i) * columns.row(i);
    sums(scan[i]) += weight(i);
  }
  for (Eigen::Index s = 0; s < scans; ++s) means.row(s) /= sums(s);
  for (Eigen::Index i = 0; i < columns.rows(); ++i) columns.row(i) -= means.row(scan[i]);
  return means;
}

}  // namespace skyfit::fit
