// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/slant_column.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "model/shared/shared.h"

namespace skyfit {
namespace {

Shared<double> shared;  // stateless

// exp(z^2) erfc(z), z >= 0.
double scaled_erfc(double z) {
  constexpr double kAsymptotic = 9;  // there the first term left out of the series is below 1e-14
  if (z < kAsymptotic) return std::exp(z * z) * std::erfc(z);
  const double q = 0.5 / (z * z);
  const double series =
      1 - q * (1 - 3 * q * (1 - 5 * q * (1 - 7 * q * (1 - 9 * q * (1 - 11 * q * (1 - 13 * q))))));
  return series / (z * std::sqrt(std::numbers::pi));
}

// Column to infinity in units of the local density times H, for mu >= 0, and its derivative by x =
// r / H. With r' the radius along the ray, u = (r' - r) / H and w^2 = mu^2 + (r'^2 - r^2) / r^2 the
// column is
//   x integral_mu^inf exp(-u) dw,   u = x (sqrt(1 + y) - 1),   y = w^2 - mu^2,
// and exp(-u) = exp(-x y / 2) (1 + x y^2 / 8 - x y^3 / 16 + x^2 y^4 / 128 + ...), each term 1 / x
// smaller.
struct Chapman {
  double value, by_x;
};
// docs/theory (1.11) and (1.12).
Chapman chapman(double x, double mu) {
  const double a = 0.5 * x;
  const double mu2 = mu * mu;
  // moments m[k] = integral_mu^inf y^k exp(-a y) dw, by parts
  std::array<double, 6> m;
  m[0] = std::sqrt(std::numbers::pi / (4 * a)) * scaled_erfc(mu * std::sqrt(a));
  m[1] = ((1 - 2 * a * mu2) * m[0] + mu) / (2 * a);
  for (int k = 1; k + 1 < static_cast<int>(m.size()); ++k) {
    m[k + 1] = ((1 + 2.0 * k - 2 * a * mu2) * m[k] + 2.0 * k * mu2 * m[k - 1]) / (2 * a);
  }
  // Beyond these the terms are below the rounding error that the recursion of m would multiply by
  // x.
  constexpr double kFirstOrder = 1e10, kSecondOrder = 1e5;
  double sum = m[0], slope = -0.5 * m[1];
  if (x < kFirstOrder) {
    sum += x * m[2] / 8;
    slope += m[2] / 8 - x * m[3] / 16;
  }
  if (x < kSecondOrder) {
    sum += -x * m[3] / 16 + x * x * m[4] / 128;
    slope += -m[3] / 16 + x * m[4] / 32 + x * m[4] / 64 - x * x * m[5] / 256;
  }
  return {x * sum, sum + x * slope};
}

// docs/theory (1.9) and (1.13).
// Untruncated column to infinity, mu >= 0: rho(h) H Ch(x, mu).
Column column_to_infinity(double bottom_radius, double height, double mu, double scale_height) {
  const double x = (bottom_radius + height) / scale_height;
  const double density = shared.exponential_density(height, scale_height);
  const Chapman c = chapman(x, mu);
  return {density * scale_height * c.value,
          {density * (c.value * (1 + height / scale_height) - x * c.by_x)}};
}

// docs/theory (1.15).
// The profile between two heights of its piece number `piece`, along a ray that leaves `height`
// upward t0 metres beyond its tangent point. t metres beyond that point (r^2 = r_t^2 + t^2) the
// height is h0 + (t^2 - t0^2) / (r + r0), which is analytic but for t = +-i r_t.
double column_between(const LinearProfile& profile, std::size_t piece, double bottom_radius,
                      double height, double t0, double low, double high) {
  static constexpr std::array<double, 4> kNode = {0.0694318442029737, 0.3300094782075719,
                                                  0.6699905217924281, 0.9305681557970263};
  static constexpr std::array<double, 4> kWeight = {0.1739274225687269, 0.3260725774312731,
                                                    0.3260725774312731, 0.1739274225687269};
  const double r0 = bottom_radius + height;
  auto distance_at = [&](double h) {
    return std::sqrt(std::max(t0 * t0 + (h - height) * (h + height + 2 * bottom_radius), 0.0));
  };
  const double begin = distance_at(low), length = distance_at(high) - begin;
  // The rule converges as the ratio to the distance of those points, r: 16^-8 in a quarter of it.
  const double parts = std::ceil(4 * length / (bottom_radius + low));
  double mean_height = 0;
  for (double part = 0; part < parts; ++part) {
    for (std::size_t i = 0; i < kNode.size(); ++i) {
      const double t = begin + length * (part + kNode[i]) / parts;
      const double gain = t * t - t0 * t0;
      const double h = height + gain / (r0 + std::sqrt(std::max(r0 * r0 + gain, 0.0)));
      mean_height += kWeight[i] * h / parts;
    }
  }
  return length * profile.density_in(piece, mean_height);
}

double rising_column(const LinearProfile& profile, double bottom_radius, double height, double mu,
                     double top) {
  const double t0 = (bottom_radius + height) * mu;
  const std::vector<double>& edge = profile.heights();
  double sum = 0;
  for (std::size_t i = 0; i + 1 < edge.size(); ++i) {
    const double low = std::max(edge[i], height), high = std::min(edge[i + 1], top);
    const bool empty = profile.densities()[i] == 0 && profile.densities()[i + 1] == 0;
    if (low < high && !empty)
      sum += column_between(profile, i, bottom_radius, height, t0, low, high);
  }
  return sum;
}

// Height of the tangent point of a ray that points down: r sin(zenith) - R.
double tangent_height(double bottom_radius, double height, double mu) {
  const double r = bottom_radius + height;
  const double sine = std::sqrt(std::max(1 - mu * mu, 0.0));
  return height - r * mu * mu / (1 + sine);
}

}  // namespace

// docs/theory (1.14).
Column exponential_column(double bottom_radius, double height, double mu, double top,
                          double scale_height) {
  auto to_infinity = [&](double h, double m) {
    return column_to_infinity(bottom_radius, h, m, scale_height);
  };
  Column c = to_infinity(height, std::abs(mu));
  if (mu < 0) {
    const Column tangent = to_infinity(tangent_height(bottom_radius, height, mu), 0);
    c = {2 * tangent.value - c.value, {2 * tangent.by_shape[0] - c.by_shape[0]}};
  }
  constexpr double kNothingAbove =
      40;  // scale heights: exp(-40) of the density at the point is beyond doubles' digits
  if (top - height < kNothingAbove * scale_height) {
    const double r = bottom_radius + height, r_top = bottom_radius + top;
    const double mu_top2 =
        ((top - height) * (top + height + 2 * bottom_radius) + r * r * mu * mu) / (r_top * r_top);
    const Column above = to_infinity(top, std::sqrt(std::max(mu_top2, 0.0)));
    c.value -= above.value;
    c.by_shape[0] -= above.by_shape[0];
  }
  return c;
}

double linear_column(const LinearProfile& profile, double bottom_radius, double height, double mu,
                     double top) {
  if (mu >= 0) return rising_column(profile, bottom_radius, height, mu, top);
  const double tangent = tangent_height(bottom_radius, height, mu);
  return 2 * rising_column(profile, bottom_radius, tangent, 0, top) -
         rising_column(profile, bottom_radius, height, -mu, top);
}

}  // namespace skyfit
