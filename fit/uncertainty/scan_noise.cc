// SPDX-License-Identifier: Apache-2.0
#include "fit/uncertainty/scan_noise.h"

#include <algorithm>
#include <cmath>

#include "fit/uncertainty/noise.h"

namespace skyfit::fit {
namespace {

double length_of(const ScanData& data, const Eigen::VectorXd& residual) {
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
  return correlation_length(directions, sum.cwiseQuotient(count.cwiseMax(1)));
}

double wavelength_correlation(const ScanData& data, const Eigen::VectorXd& residual) {
  double products = 0, squares = 0;
  for (std::size_t r = 0; r + 1 < data.rows.size(); ++r) {
    if (data.rows[r].look != data.rows[r + 1].look) continue;
    const double a = residual(static_cast<Eigen::Index>(r)),
                 b = residual(static_cast<Eigen::Index>(r + 1));
    products += a * b;
    squares += 0.5 * (a * a + b * b);
  }
  return products > 0 && squares > 0 ? std::min(products / squares, 0.999) : 0;
}

// First look of each scan that has one, and the number of looks at the end.
std::vector<std::size_t> scan_borders(const ScanData& data) {
  std::vector<std::size_t> borders;
  for (std::size_t look = 0; look < data.looks.size(); ++look) {
    if (look == 0 || data.looks[look].scan != data.looks[look - 1].scan) borders.push_back(look);
  }
  borders.push_back(data.looks.size());
  return borders;
}

Eigen::MatrixXd correlation_of_looks(const ScanData& data, std::size_t first, std::size_t last,
                                     double length) {
  std::vector<SkyPoint> points;
  for (std::size_t look = first; look < last; ++look) points.push_back(data.looks[look].stated);
  return angular_correlation(points, length);
}

double share_of_directions(const ScanData& data, double length) {
  const std::vector<std::size_t> borders = scan_borders(data);
  double independent = 0;
  for (std::size_t s = 0; s + 1 < borders.size(); ++s) {
    const auto count = static_cast<double>(borders[s + 1] - borders[s]);
    independent +=
        count * count / correlation_of_looks(data, borders[s], borders[s + 1], length).sum();
  }
  return independent / static_cast<double>(data.looks.size());
}

double share_of_wavelengths(const ScanData& data, double correlation) {
  double pairs = 0, wavelengths = 0;
  for (const int count : data.rows_per_look()) {
    wavelengths += count;
    pairs += count;
    for (int lag = 1; lag < count; ++lag) pairs += 2 * (count - lag) * std::pow(correlation, lag);
  }
  return wavelengths / pairs;
}

}  // namespace

ScanNoise scan_noise(const ScanData& data, const Eigen::VectorXd& residual, int unknowns) {
  const auto rows = static_cast<double>(data.rows.size());
  ScanNoise noise;
  noise.length = length_of(data, residual);
  noise.wavelength_correlation = wavelength_correlation(data, residual);
  const double of_wavelengths = share_of_wavelengths(data, noise.wavelength_correlation);
  noise.effective_samples =
      std::max(1.0, rows * share_of_directions(data, noise.length) * of_wavelengths);
  const double freedom = std::max(1.0, rows - unknowns);
  noise.independent_factor = std::sqrt(std::max(residual.squaredNorm() / freedom, 1e-12));
  noise.factor = noise.independent_factor / std::sqrt(of_wavelengths);
  return noise;
}

Eigen::MatrixXd times_correlation(const ScanData& data, const ScanNoise& noise,
                                  const Eigen::MatrixXd& columns) {
  const auto channels = static_cast<Eigen::Index>(data.channels.size());
  const auto looks = static_cast<Eigen::Index>(data.looks.size());
  Eigen::MatrixXd along(channels, channels);
  for (Eigen::Index a = 0; a < channels; ++a) {
    for (Eigen::Index b = 0; b < channels; ++b)
      along(a, b) = std::pow(noise.wavelength_correlation, std::abs(a - b));
  }
  const std::vector<std::size_t> borders = scan_borders(data);
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  for (Eigen::Index column = 0; column < columns.cols(); ++column) {
    Eigen::MatrixXd grid = Eigen::MatrixXd::Zero(looks, channels);
    for (std::size_t r = 0; r < data.rows.size(); ++r)
      grid(data.rows[r].look, data.rows[r].channel) +=
          columns(static_cast<Eigen::Index>(r), column);
    grid = grid * along;
    for (std::size_t s = 0; s + 1 < borders.size(); ++s) {
      const auto first = static_cast<Eigen::Index>(borders[s]),
                 count = static_cast<Eigen::Index>(borders[s + 1] - borders[s]);
      grid.middleRows(first, count) =
          correlation_of_looks(data, borders[s], borders[s + 1], noise.length) *
          grid.middleRows(first, count);
    }
    for (std::size_t r = 0; r < data.rows.size(); ++r)
      result(static_cast<Eigen::Index>(r), column) = grid(data.rows[r].look, data.rows[r].channel);
  }
  return result;
}

}  // namespace skyfit::fit
