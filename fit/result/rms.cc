// SPDX-License-Identifier: Apache-2.0
#include "fit/result/rms.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace skyfit::fit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kAnySun = 180 * kDegree;

struct Selection {
  Observations observations;
  LogResiduals residuals;  // times the square root of the weight
};

Selection selection(const refs::Reference& reference, const Luminance& luminance,
                    double exclude_sun, double largest_sun_zenith) {
  Selection result{observe(reference, exclude_sun, largest_sun_zenith), {}};
  result.observations.sigma_log.setOnes();
  if (result.observations.count() > 0) {
    result.residuals = log_residuals(result.observations, select(luminance, result.observations));
  }
  return result;
}

// docs/theory (12.9).
double rms_percent(const Selection& selected) {
  if (selected.observations.count() == 0) return std::numeric_limits<double>::quiet_NaN();
  return 100 *
         std::sqrt(selected.residuals.residual.squaredNorm() / selected.observations.weight.sum());
}

}  // namespace

RmsSummary rms_summary(const refs::Reference& reference, const Luminance& luminance,
                       double exclude_sun) {
  const auto rms = [&](double cone, double sun) {
    return rms_percent(selection(reference, luminance, cone, sun));
  };
  return {rms(exclude_sun, kAnySun), rms(3 * kDegree, kAnySun), rms(10 * kDegree, kAnySun),
          rms(exclude_sun, 70 * kDegree)};
}

std::vector<RmsOfSun> rms_per_sun(const refs::Reference& reference, const Luminance& luminance,
                                  double exclude_sun) {
  const Selection selected = selection(reference, luminance, exclude_sun, kAnySun);
  const Observations& observations = selected.observations;
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(observations.scans);
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(observations.scans);
  for (int i = 0; i < observations.count(); ++i) {
    squares(observations.scan[i]) += std::pow(selected.residuals.residual(i), 2);
    weights(observations.scan[i]) += observations.weight(i);
  }
  std::vector<RmsOfSun> result;
  for (int s = 0; s < observations.scans; ++s) {
    result.push_back({observations.sun_zenith[s], 100 * std::sqrt(squares(s) / weights(s)),
                      std::exp(selected.residuals.log_scale(s))});
  }
  return result;
}

}  // namespace skyfit::fit
