// SPDX-License-Identifier: Apache-2.0
#include "fit/uncertainty/noise.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

namespace skyfit::fit {
namespace {

Eigen::Vector3d direction(const SkyPoint& point) {
  return {std::sin(point.view_zenith) * std::cos(point.relative_azimuth),
          std::sin(point.view_zenith) * std::sin(point.relative_azimuth),
          std::cos(point.view_zenith)};
}

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

// exp(-angle / length) between the directions; the unit matrix for a length of 0.
Eigen::MatrixXd angular_correlation(const std::vector<SkyPoint>& points, double length) {
  const auto count = static_cast<Eigen::Index>(points.size());
  if (!(length > 0)) return Eigen::MatrixXd::Identity(count, count);
  return (angles_between(points).array() / -length).exp();
}

// First line of sight of each scan that has one, and the number of them at the end.
std::vector<std::size_t> scan_borders(const Dataset& data) {
  std::vector<std::size_t> borders;
  const std::vector<LineOfSight>& lines = data.lines_of_sight;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    if (line == 0 || lines[line].scan != lines[line - 1].scan) borders.push_back(line);
  }
  borders.push_back(lines.size());
  return borders;
}

std::vector<SkyPoint> directions_of(const Dataset& data, std::size_t first, std::size_t last) {
  std::vector<SkyPoint> points;
  for (std::size_t line = first; line < last; ++line)
    points.push_back(data.lines_of_sight[line].stated);
  return points;
}

// Mean residual of each line of sight.
Eigen::VectorXd means_of(const Dataset& data, const Eigen::VectorXd& residual) {
  Eigen::VectorXd sum =
      Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.lines_of_sight.size()));
  Eigen::VectorXd count = sum;
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    sum(data.samples[i].line_of_sight) += residual(static_cast<Eigen::Index>(i));
    count(data.samples[i].line_of_sight) += 1;
  }
  return sum.cwiseQuotient(count.cwiseMax(1));
}

// docs/theory (12.2).
// exp(-angle / length) from the products of nearest neighbours; 0 when they do not agree.
double length_of(const Dataset& data, const Eigen::VectorXd& residual) {
  const Eigen::VectorXd mean = means_of(data, residual);
  const std::vector<std::size_t> borders = scan_borders(data);
  double products = 0, squares = 0, angles = 0;
  int pairs = 0;
  for (std::size_t s = 0; s + 1 < borders.size(); ++s) {
    if (borders[s + 1] - borders[s] < 2) continue;
    const Eigen::MatrixXd angle = angles_between(directions_of(data, borders[s], borders[s + 1]));
    const auto first = static_cast<Eigen::Index>(borders[s]);
    for (Eigen::Index i = 0; i < angle.cols(); ++i) {
      Eigen::VectorXd others = angle.col(i);
      others(i) = 10;  // not itself
      Eigen::Index nearest = 0;
      angles += others.minCoeff(&nearest);
      const double own = mean(first + i), neighbour = mean(first + nearest);
      products += own * neighbour;
      squares += 0.5 * (own * own + neighbour * neighbour);
      ++pairs;
    }
  }
  if (pairs == 0 || !(products > 0) || !(squares > 0)) return 0;
  return -(angles / pairs) / std::log(std::min(products / squares, 0.999));
}

double wavelength_correlation(const Dataset& data, const Eigen::VectorXd& residual) {
  double products = 0, squares = 0;
  for (std::size_t i = 0; i + 1 < data.samples.size(); ++i) {
    if (data.channels.size() < 2) break;
    if (data.samples[i].line_of_sight != data.samples[i + 1].line_of_sight) continue;
    const double a = residual(static_cast<Eigen::Index>(i)),
                 b = residual(static_cast<Eigen::Index>(i + 1));
    products += a * b;
    squares += 0.5 * (a * a + b * b);
  }
  return products > 0 && squares > 0 ? std::min(products / squares, 0.999) : 0;
}

// docs/theory (12.3).
double share_of_directions(const Dataset& data, double length) {
  const std::vector<std::size_t> borders = scan_borders(data);
  double independent = 0;
  for (std::size_t s = 0; s + 1 < borders.size(); ++s) {
    const auto count = static_cast<double>(borders[s + 1] - borders[s]);
    independent +=
        count * count /
        angular_correlation(directions_of(data, borders[s], borders[s + 1]), length).sum();
  }
  return independent / static_cast<double>(data.lines_of_sight.size());
}

double share_of_wavelengths(const Dataset& data, double correlation) {
  double pairs = 0, wavelengths = 0;
  for (const int count : data.samples_per_line_of_sight()) {
    wavelengths += count;
    pairs += count;
    for (int lag = 1; lag < count; ++lag) pairs += 2 * (count - lag) * std::pow(correlation, lag);
  }
  return wavelengths / pairs;
}

// Of samples of one kind.
Eigen::MatrixXd times_correlation_of_kind(const Dataset& data, const Noise& noise,
                                          const Eigen::MatrixXd& columns) {
  const auto channels = static_cast<Eigen::Index>(data.channels.size());
  const auto lines = static_cast<Eigen::Index>(data.lines_of_sight.size());
  Eigen::MatrixXd along(channels, channels);
  for (Eigen::Index a = 0; a < channels; ++a) {
    for (Eigen::Index b = 0; b < channels; ++b)
      along(a, b) = std::pow(noise.wavelength_correlation, std::abs(a - b));
  }
  const std::vector<std::size_t> borders = scan_borders(data);
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  for (Eigen::Index column = 0; column < columns.cols(); ++column) {
    Eigen::MatrixXd grid = Eigen::MatrixXd::Zero(lines, channels);
    for (std::size_t i = 0; i < data.samples.size(); ++i)
      grid(data.samples[i].line_of_sight, data.samples[i].channel) +=
          columns(static_cast<Eigen::Index>(i), column);
    grid = grid * along;
    for (std::size_t s = 0; s + 1 < borders.size(); ++s) {
      const auto first = static_cast<Eigen::Index>(borders[s]),
                 count = static_cast<Eigen::Index>(borders[s + 1] - borders[s]);
      grid.middleRows(first, count) =
          angular_correlation(directions_of(data, borders[s], borders[s + 1]), noise.length) *
          grid.middleRows(first, count);
    }
    for (std::size_t i = 0; i < data.samples.size(); ++i)
      result(static_cast<Eigen::Index>(i), column) =
          grid(data.samples[i].line_of_sight, data.samples[i].channel);
  }
  return result;
}

}  // namespace

// docs/theory (12.1) and (12.4).
Noise estimate_noise(const Dataset& all, const Likelihood& likelihood,
                     const Eigen::VectorXd& residual_of_all, const Eigen::VectorXd& weights_of_all,
                     double determined) {
  const Dataset data = only_sky(all);
  const auto of_sky = static_cast<Eigen::Index>(data.samples.size());
  const Eigen::VectorXd weights = weights_of_all.head(of_sky);
  const Eigen::VectorXd residual = weights.cwiseSqrt().cwiseProduct(residual_of_all.head(of_sky));
  const auto count = static_cast<double>(data.samples.size());
  const std::vector<int> indices = radiances(data);
  const Dataset others = only_samples(data, indices);
  const Eigen::VectorXd of_radiances = residual(indices);
  Noise noise;
  noise.length = length_of(others, of_radiances);
  noise.wavelength_correlation = wavelength_correlation(others, of_radiances);
  const double of_wavelengths = share_of_wavelengths(others, noise.wavelength_correlation);
  const double of_all = share_of_directions(data, noise.length) * of_wavelengths;
  noise.effective_samples = std::max(1.0, count * of_all);
  const double freedom = std::max(1.0, weights.sum() - determined);
  noise.independent_factor = std::sqrt(std::max(residual.squaredNorm() / freedom, 1e-12));
  if (likelihood.link == Link::kLinear) {
    noise.factor = noise.independent_factor / std::sqrt(of_wavelengths);
  } else {
    noise.factor = std::max(noise.independent_factor * std::sqrt(count / noise.effective_samples),
                            kSmallestSigma / likelihood.noise.relative);
  }
  return noise;
}

Eigen::MatrixXd times_correlation(const Dataset& data, const Noise& noise,
                                  const Eigen::MatrixXd& columns) {
  std::map<std::optional<refs::Polarisation>, std::vector<int>> kinds;
  for (std::size_t i = 0; i < data.samples.size(); ++i)
    kinds[data.samples[i].polarisation].push_back(static_cast<int>(i));
  Eigen::MatrixXd result(columns.rows(), columns.cols());
  for (const auto& [kind, indices] : kinds) {
    result(indices, Eigen::all) =
        times_correlation_of_kind(only_samples(data, indices), noise, columns(indices, Eigen::all));
  }
  return result;
}

}  // namespace skyfit::fit
