// SPDX-License-Identifier: Apache-2.0
#include "model/solver/streams.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "model/numerics/gauss.h"

namespace skyfit {
namespace {

// Where limb rays begin: at the levels nearest to these cube roots of the height over the top's.
// Three times as many rays of the Earth's day change the multiple scattering seen from 0 .. 20 km
// and along the limb by less than 1 %; on Mars and Titan there must be as many.
std::span<const double> limb_levels(LimbRays rays) {
  static constexpr double kOfDay[] = {0.2, 0.35, 0.47, 0.6, 0.7, 0.8, 0.9};
  static constexpr double kOfTwilight[] = {0.2,  0.35, 0.42, 0.46, 0.5, 0.54, 0.58,
                                           0.62, 0.66, 0.7,  0.75, 0.8, 0.85, 0.9};
  static constexpr std::array<double, 28> kOfExtended = [] {
    constexpr double kFirst = 0.1, kLast = 0.95;
    std::array<double, 28> shares{};
    for (std::size_t i = 0; i < shares.size(); ++i)
      shares[i] = kFirst + (kLast - kFirst) * static_cast<double>(i) / (shares.size() - 1);
    return shares;
  }();
  switch (rays) {
    case LimbRays::kOfDay:
      return kOfDay;
    case LimbRays::kOfTwilight:
      return kOfTwilight;
    case LimbRays::kOfExtended:
      return kOfExtended;
  }
  return {};
}

// P_l(mu), l = 0 .. count - 1.
Eigen::VectorXd legendre(double mu, int count) {
  Eigen::VectorXd p(count);
  double before = 0, current = 1;
  for (int l = 0; l < count; ++l) {
    p[l] = current;
    const double next = ((2 * l + 1) * mu * current - l * before) / (l + 1);
    before = current;
    current = next;
  }
  return p;
}

}  // namespace

// docs/theory (3.4) to (3.6).
Streams::Streams(double bottom_radius, const std::vector<double>& heights, int ground_rays,
                 LimbRays limb_rays) {
  const int levels = static_cast<int>(heights.size());
  std::vector<int> touched;
  for (const double share : limb_levels(limb_rays)) {
    const auto apart = [&](double h) { return std::abs(std::cbrt(h / heights.back()) - share); };
    const int level =
        static_cast<int>(std::ranges::min_element(heights, {}, apart) - heights.begin());
    if (level > 0 && (touched.empty() || level > touched.back())) touched.push_back(level);
  }
  for (int i = 0; i < levels; ++i) {
    count_.push_back(
        ground_rays +
        static_cast<int>(std::upper_bound(touched.begin(), touched.end(), i) - touched.begin()));
  }
  mu_.resize(static_cast<std::size_t>(levels) * most());
  weight_.resize(mu_.size());
  const GaussRule gauss = gauss_legendre(ground_rays);
  for (int i = 0; i < levels; ++i) {
    const double h = heights[i], r = bottom_radius + h;
    const double to_ground = h * (2 * bottom_radius + h);  // r^2 - R^2
    const double horizon_mu = std::sqrt(to_ground) / r;
    for (int k = 0; k < count_[i]; ++k) {
      double& mu = mu_[static_cast<std::size_t>(i) * most() + k];
      double& weight = weight_[static_cast<std::size_t>(i) * most() + k];
      if (k < ground_rays) {
        const double x = gauss.node[k];
        mu = std::sqrt(x * x * bottom_radius * bottom_radius + to_ground) / r;
        weight = gauss.weight[k] * (bottom_radius / r) * (bottom_radius / r) * x / mu;
      } else {
        const double low = heights[touched[k - ground_rays]];
        mu = std::sqrt((h - low) * (2 * bottom_radius + h + low)) / r;
      }
    }
    // Between 0 and the horizon radiance is taken as linear from ray to ray.
    double* const weight = &weight_[static_cast<std::size_t>(i) * most()];
    double upper = horizon_mu;
    for (int k = ground_rays; k < count_[i]; ++k) {
      const int above = k == ground_rays ? 0 : k - 1;
      const double length = upper - mu(i, k);
      const double share = 0.5 * length / (mu(i, above) - mu(i, k));
      weight[above] += length * share;
      weight[k] += length * (1 - share);
      upper = mu(i, k);
    }
    weight[count_[i] - 1] += count_[i] > ground_rays ? upper : 0;
    if (i > 0) correct_weights(i);
  }
}

// docs/theory (3.7) and (3.8).
// Rays to the ground that do not resolve the band between them and the horizon stand for a part of
// it already. The weights near the horizon are moved, as little as possible, so that 1, P_2, P_4
// and mu integrate to 1, 0, 0 and 1/2: scattering loses nothing.
void Streams::correct_weights(int level) {
  const int rays = count_[level];
  constexpr int kEven = 3;  // P_0, P_2 and P_4
  Eigen::MatrixXd constraint(kEven + 1, rays);
  Eigen::VectorXd wanted = Eigen::VectorXd::Zero(constraint.rows());
  wanted[0] = 1;
  wanted[kEven] = 0.5;
  for (int k = 0; k < rays; ++k) {
    const Eigen::VectorXd p = legendre(mu(level, k), 2 * kEven);
    for (int l = 0; l < kEven; ++l) constraint(l, k) = p[2 * l];
    constraint(kEven, k) = mu(level, k);
  }
  Eigen::Map<Eigen::VectorXd> weight(&weight_[static_cast<std::size_t>(level) * most()], rays);
  constexpr double kNearHorizon = 0.05;  // cosine within which the weights may move
  Eigen::VectorXd freedom = weight;
  for (int k = 0; k < rays; ++k) freedom[k] *= std::exp(-mu(level, k) / kNearHorizon);
  const Eigen::MatrixXd scaled = constraint * freedom.asDiagonal();
  const Eigen::VectorXd multiplier =
      (scaled * constraint.transpose()).ldlt().solve(wanted - constraint * weight);
  weight += freedom.asDiagonal() * (constraint.transpose() * multiplier);
}

}  // namespace skyfit
