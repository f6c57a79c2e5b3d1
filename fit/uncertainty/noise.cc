// SPDX-License-Identifier: Apache-2.0
#include "fit/uncertainty/noise.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace skyfit::fit {
namespace {

Eigen::Vector3d direction(const SkyPoint& point) {
  return {std::sin(point.view_zenith) * std::cos(point.relative_azimuth),
          std::sin(point.view_zenith) * std::sin(point.relative_azimuth),
          std::cos(point.view_zenith)};
}

// Angles between the view directions of one scan, radians, and its residuals.
struct Scan {
  Eigen::MatrixXd angle;
  Eigen::VectorXd residual;
};

Eigen::MatrixXd angles_between(const std::vector<SkyPoint>& points) {
  const auto count = static_cast<Eigen::Index>(points.size());
  Eigen::Matrix3Xd directions(3, count);
  for (Eigen::Index i = 0; i < count; ++i)
    directions.col(i) = direction(points[static_cast<std::size_t>(i)]);
  Eigen::MatrixXd angle(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    for (Eigen::Index j = 0; j < count; ++j) {
      const double chord = (directions.col(i) - directions.col(j)).norm();
      angle(i, j) = 2 * std::asin(std::min(1.0, 0.5 * chord));
    }
  }
  return angle;
}

std::vector<Scan> split(const Observations& observations, const Eigen::VectorXd& residual) {
  std::vector<std::vector<int>> members(observations.scans);
  for (int i = 0; i < observations.count(); ++i) members[observations.scan[i]].push_back(i);
  std::vector<Scan> result;
  for (const std::vector<int>& member : members) {
    std::vector<SkyPoint> points;
    for (const int i : member) points.push_back(observations.points[i]);
    result.push_back({angles_between(points), residual(member)});
  }
  return result;
}

// docs/theory (12.2).
// exp(-angle / length) from the products of nearest neighbours; 0 when they do not agree.
double length_of(const std::vector<Scan>& scans) {
  double products = 0, squares = 0, angles = 0;
  int pairs = 0;
  for (const Scan& scan : scans) {
    for (Eigen::Index i = 0; i < scan.residual.size() && scan.residual.size() > 1; ++i) {
      Eigen::VectorXd others = scan.angle.col(i);
      others(i) = 10;  // not itself
      Eigen::Index nearest = 0;
      angles += others.minCoeff(&nearest);
      products += scan.residual(i) * scan.residual(nearest);
      squares += 0.5 * (std::pow(scan.residual(i), 2) + std::pow(scan.residual(nearest), 2));
      ++pairs;
    }
  }
  if (pairs == 0 || !(products > 0) || !(squares > 0)) return 0;
  const double correlation = std::min(products / squares, 0.999);
  return -(angles / pairs) / std::log(correlation);
}

// docs/theory (12.3).
double effective_count(const std::vector<Scan>& scans, double length) {
  double result = 0;
  for (const Scan& scan : scans) {
    const double count = static_cast<double>(scan.residual.size());
    if (!(length > 0)) {
      result += count;
      continue;
    }
    result += count * count / (scan.angle.array() / -length).exp().sum();
  }
  return result;
}

}  // namespace

double correlation_length(const Observations& observations, const Eigen::VectorXd& residual) {
  return length_of(split(observations, residual));
}

Eigen::MatrixXd angular_correlation(const std::vector<SkyPoint>& points, double length) {
  const auto count = static_cast<Eigen::Index>(points.size());
  if (!(length > 0)) return Eigen::MatrixXd::Identity(count, count);
  return (angles_between(points).array() / -length).exp();
}

// docs/theory (12.1).
Noise estimate_noise(const Observations& observations, const Eigen::VectorXd& residual,
                     int free_parameters) {
  const double count = observations.count();
  const double variance = observations.weight.dot(residual.cwiseAbs2()) / observations.weight.sum();
  const double freedom = std::max(1.0, count - observations.scans - free_parameters);
  Noise noise;
  const std::vector<Scan> scans = split(observations, residual);
  noise.effective_samples = effective_count(scans, length_of(scans));
  noise.sigma_log = std::max(
      kSmallestSigmaLog, std::sqrt(variance * count / freedom * count / noise.effective_samples));
  return noise;
}

}  // namespace skyfit::fit
