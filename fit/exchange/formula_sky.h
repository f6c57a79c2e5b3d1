// SPDX-License-Identifier: Apache-2.0
// Skies of programs that are a formula and no atmosphere, fitted to the sky of a preset. One such
// formula is that of S. Wallner and M. Upitis after Preetham, Shirley & Smits 1999, which three.js
// has and Godot took over.
#pragma once

#include <ceres/ceres.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "fit/exchange/srgb.h"

namespace skyfit::fit {

// One channel's coefficients, 1/m.
template <class T>
struct FormulaAir {
  T rayleigh, mie, g;
  T depth(double air_mass) const { return (8400.0 * rayleigh + 1250.0 * mie) * air_mass; }
};

// With T = exp(-depth), (E P (1 - T))^1.5 (1 - f + f (E P T)^0.5), P the mean of 3 / (16 pi) (1 +
// ((1 + nu) / 2)^2) and of Henyey & Greenstein's phase function weighted by the coefficients, f =
// (1 - mu_s)^5.
template <class T>
T formula_light(const FormulaAir<T>& air, double sun_energy, double air_mass, const SkyPoint& p) {
  using std::exp, std::pow, std::sqrt;
  constexpr double kPi = std::numbers::pi;
  const double nu = std::clamp(std::cos(angle_from_sun(p)), -1.0, 1.0);
  const T denominator = 1.0 + air.g * air.g - 2.0 * nu * air.g;
  const T mie_phase = (1.0 - air.g * air.g) / (4 * kPi * denominator * sqrt(denominator));
  const double rayleigh_phase = 3 / (16 * kPi) * (1 + 0.25 * (1 + nu) * (1 + nu));
  const T scattered =
      sun_energy * (air.rayleigh * rayleigh_phase + air.mie * mie_phase) / (air.rayleigh + air.mie);
  const T depth = air.depth(air_mass);
  const double low = std::pow(1 - std::cos(p.sun_zenith), 5);
  return pow(scattered * (1.0 - exp(-depth)), 1.5) *
         (1 - low + low * sqrt(scattered) * exp(-0.5 * depth));
}

template <int kCount>
using Unknowns = std::array<double, kCount>;

template <int kCount>
struct FormulaFit {
  Unknowns<kCount> lower, upper;         // infinite where there is no bound
  std::vector<Unknowns<kCount>> starts;  // the best of their minima is taken
};

template <int kCount, class Color>
struct FormulaResidual {
  const Color& color;
  SkyPoint point;
  std::size_t channel;
  double log_truth;
  template <class T>
  bool operator()(const T* parameters, T* residual) const {
    std::array<T, kCount> x;
    std::copy_n(parameters, kCount, x.begin());
    residual[0] = ceres::log(color(x, channel, point)) - log_truth;
    return true;
  }
};

// The unknowns for which color(x, channel, point), positive, is nearest to `truth`,
// [point][channel], in logarithms, without directions within 3 deg of the sun (as color_loss()) and
// what is not positive in `truth`. `color` takes an array of double or of ceres::Jet. Throws
// std::runtime_error where the fit fails.
template <int kCount, class Color>
Unknowns<kCount> fitted(const Color& color, const FormulaFit<kCount>& fit,
                        const std::vector<SkyPoint>& points,
                        const std::vector<std::array<double, 3>>& truth,
                        const std::function<void(double)>& progress) {
  using Residual = FormulaResidual<kCount, Color>;
  constexpr double kClose = 3 * std::numbers::pi / 180;
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_NORMAL_CHOLESKY;
  options.max_num_iterations = 200;
  options.logging_type = ceres::SILENT;
  Unknowns<kCount> best{};
  double lowest = std::numeric_limits<double>::infinity(), done = 0;
  for (Unknowns<kCount> x : fit.starts) {
    ceres::Problem problem;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (angle_from_sun(points[i]) < kClose) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        if (truth[i][k] <= 0) continue;
        problem.AddResidualBlock(new ceres::AutoDiffCostFunction<Residual, 1, kCount>(
                                     new Residual{color, points[i], k, std::log(truth[i][k])}),
                                 nullptr, x.data());
      }
    }
    for (int k = 0; k < kCount; ++k) {
      const auto at = static_cast<std::size_t>(k);
      if (std::isfinite(fit.lower[at])) problem.SetParameterLowerBound(x.data(), k, fit.lower[at]);
      if (std::isfinite(fit.upper[at])) problem.SetParameterUpperBound(x.data(), k, fit.upper[at]);
    }
    ceres::Solver::Summary summary;
    ceres::Solve(options, &problem, &summary);
    if (!summary.IsSolutionUsable())
      throw std::runtime_error("the program's formula cannot be fitted: " + summary.message);
    if (summary.final_cost < lowest) {
      lowest = summary.final_cost;
      best = x;
    }
    progress(++done / static_cast<double>(fit.starts.size()));
  }
  return best;
}

}  // namespace skyfit::fit
