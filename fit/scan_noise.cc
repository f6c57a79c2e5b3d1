// SPDX-License-Identifier: Apache-2.0
#include "fit/scan_noise.h"

#include <algorithm>
#include <cmath>

#include "fit/noise.h"

namespace skyfit::fit {
namespace {

double independent_directions(const ScanData& data, const Eigen::VectorXd& residual) {
  Observations directions;
  directions.scans = static_cast<int>(data.scans.size());
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.looks.size()));
  Eigen::VectorXd count = sum;
  for (std::size_t r = 0; r < data.rows.size(); ++r) {
    sum(data.rows[r].look) += residual(static_cast<Eigen::Index>(r));
    count(data.rows[r].look) += 1;
  }
  for (const Look& look : data.looks) {
    directions.points.push_back(look.stated);
    directions.scan.push_back(look.scan);
  }
  return independent_samples(directions, sum.cwiseQuotient(count));
}

// The share of the wavelengths of a direction that are independent.
double independent_share_of_wavelengths(const ScanData& data, const Eigen::VectorXd& residual) {
  double products = 0, squares = 0;
  for (std::size_t r = 0; r + 1 < data.rows.size(); ++r) {
    if (data.rows[r].look != data.rows[r + 1].look) continue;
    const double a = residual(static_cast<Eigen::Index>(r)),
                 b = residual(static_cast<Eigen::Index>(r + 1));
    products += a * b;
    squares += 0.5 * (a * a + b * b);
  }
  if (!(products > 0) || !(squares > 0)) return 1;
  const double correlation = std::min(products / squares, 0.999);
  double pairs = 0, wavelengths = 0;
  for (const int count : data.rows_per_look()) {
    wavelengths += count;
    double sum = count;
    for (int lag = 1; lag < count; ++lag) sum += 2 * (count - lag) * std::pow(correlation, lag);
    pairs += sum;
  }
  return wavelengths / pairs;
}

}  // namespace

ScanNoise scan_noise(const ScanData& data, const Eigen::VectorXd& residual, int unknowns) {
  const auto rows = static_cast<double>(data.rows.size());
  const auto looks = static_cast<double>(data.looks.size());
  const double share = independent_directions(data, residual) / looks *
                       independent_share_of_wavelengths(data, residual);
  const double effective = std::max(1.0, rows * share);
  const double freedom = std::max(1.0, rows - unknowns);
  return {std::sqrt(std::max(residual.squaredNorm() / freedom * rows / effective, 1e-12)),
          effective};
}

}  // namespace skyfit::fit
