// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/observations.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <stdexcept>

namespace skyfit::fit {
namespace {

void check(const refs::Reference& reference, std::size_t index) {
  const refs::Sample& sample = reference.samples[index];
  const auto fail = [&](std::string_view field, double value, std::string_view expected) {
    throw std::invalid_argument(fmt::format("{}: sample {}: {} = {:.9g}: must be {}",
                                            reference.name, index + 1, field, value, expected));
  };
  if (!(sample.value > 0) || !std::isfinite(sample.value)) {
    fail("value", sample.value, "finite and > 0 for a logarithmic residual");
  }
  if (!std::isfinite(sample.weight) || sample.weight < 0) fail("weight", sample.weight, ">= 0");
  if (sample.sigma && !(*sample.sigma > 0 && std::isfinite(*sample.sigma))) {
    fail("sigma", *sample.sigma, "finite and > 0");
  }
}

}  // namespace

SkyPoint sky_point(const refs::Sample& sample) {
  return {0, sample.sun_zenith, sample.view_zenith, sample.relative_azimuth};
}

Observations observe(const refs::Reference& reference, double exclude_sun,
                     double largest_sun_zenith) {
  constexpr double kRounding = 1e-9;  // radians: a sample on the rim of the cone stays in
  Observations result;
  std::map<int, int> index_of_scan;
  std::vector<double> log_reference, weight, sigma_log;
  int with_sigma = 0;
  for (std::size_t i = 0; i < reference.samples.size(); ++i) {
    const refs::Sample& sample = reference.samples[i];
    if (sample.weight == 0) continue;
    check(reference, i);
    if (refs::scattering_angle(sample) < exclude_sun - kRounding) continue;
    if (sample.sun_zenith > largest_sun_zenith + kRounding) continue;
    const auto [scan, is_new] = index_of_scan.emplace(sample.scan, result.scans);
    if (is_new) {
      result.scan_name.push_back(sample.scan);
      result.sun_zenith.push_back(sample.sun_zenith);
      ++result.scans;
    }
    result.sample.push_back(i);
    result.points.push_back(sky_point(sample));
    result.scan.push_back(scan->second);
    log_reference.push_back(std::log(sample.value));
    weight.push_back(sample.weight);
    sigma_log.push_back(sample.sigma ? *sample.sigma / sample.value : 1.0);
    if (sample.sigma) ++with_sigma;
  }
  if (with_sigma != 0 && with_sigma != result.count()) {
    throw std::invalid_argument(
        fmt::format("{}: {} of {} fitted samples have a sigma: must be all or none", reference.name,
                    with_sigma, result.count()));
  }
  const auto as_vector = [](const std::vector<double>& values) -> Eigen::VectorXd {
    return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                             static_cast<Eigen::Index>(values.size()));
  };
  result.has_sigma = with_sigma > 0;
  result.log_reference = as_vector(log_reference);
  result.weight = as_vector(weight);
  result.sigma_log = as_vector(sigma_log);
  return result;
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
