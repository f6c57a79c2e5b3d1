// SPDX-License-Identifier: Apache-2.0
// A place along a row of texels, and the cubic B-spline's weights of the four around it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace skyfit {

struct CubicSpline {
  // `u`: in texels from the beginning of the first one.
  explicit CubicSpline(double u) {
    const double floor = std::floor(u - 0.5), t = u - 0.5 - floor, s = 1 - t;
    first = static_cast<int>(floor) - 1;
    weight = {s * s * s / 6, (4 - 6 * t * t + 3 * t * t * t) / 6,
              (4 - 6 * s * s + 3 * s * s * s) / 6, t * t * t / 6};
  }
  int first;
  std::array<double, 4> weight;
};

// The B-spline's weights have variance 1/3 along each axis: of a ramp of slope s, per texel, the
// weighted mean of squares is that of the mean plus s^2 / 3. Returns s.
inline double spline_slope(double mean, double mean_square) {
  return std::sqrt(3 * std::max(mean_square - mean * mean, 0.0));
}

}  // namespace skyfit
