// SPDX-License-Identifier: Apache-2.0
#include "model/geometry/sun_along_ray.h"

#include <algorithm>
#include <cmath>

#include "model/shared/shared.h"

namespace skyfit {

// docs/theory (1.3) and (1.7).
SunAlongRay::SunAlongRay(double bottom_radius, const ViewRay& ray, const SkyPoint& point)
    : bottom_radius_(bottom_radius), ray_(ray) {
  const double mu = std::cos(point.view_zenith), mu_s = std::cos(point.sun_zenith);
  nu_ = mu * mu_s +
        std::sin(point.view_zenith) * std::sin(point.sun_zenith) * std::cos(point.relative_azimuth);
  nu_ = std::clamp(nu_, -1.0, 1.0);
  up_ = std::sin(point.view_zenith) * mu_s -
        mu * std::sin(point.sun_zenith) * std::cos(point.relative_azimuth);
  right_ = std::sin(point.sun_zenith) * std::sin(point.relative_azimuth);
  radius_mu_s_ = (bottom_radius + point.altitude_m) * mu_s + ray.entry_distance * nu_;
}

double SunAlongRay::mu_s(const RayPoint& p) const {
  return std::clamp((radius_mu_s_ + p.s * nu_) / (bottom_radius_ + p.height), -1.0, 1.0);
}

double SunAlongRay::cos_azimuth(const RayPoint& p, double mu_s) const {
  const double sines = std::sqrt((1 - p.mu * p.mu) * (1 - mu_s * mu_s));
  constexpr double kVertical = 1e-9;  // there the series has no azimuth left: Lambda_lm ~ sin^m
  if (sines < kVertical) return 1;
  return std::clamp((nu_ - p.mu * mu_s) / sines, -1.0, 1.0);
}

// docs/theory (13.4).
SunAlongRay::Azimuth SunAlongRay::azimuth(const RayPoint& p, double mu_s) const {
  const double sun_sine = std::sqrt(1 - mu_s * mu_s), sine = std::sqrt(1 - p.mu * p.mu);
  constexpr double kVertical = 1e-9;  // there the field has no azimuth left
  if (sun_sine < kVertical) return {};
  return {std::clamp((sine * nu_ - p.mu * up_) / sun_sine, -1.0, 1.0),
          std::clamp(right_ / sun_sine, -1.0, 1.0)};
}

// docs/theory (13.3).
SunAlongRay::Azimuth SunAlongRay::twice_the_turn() const {
  const double square = up_ * up_ + right_ * right_;
  if (square == 0) return {};
  return {(up_ * up_ - right_ * right_) / square, 2 * up_ * right_ / square};
}

bool SunAlongRay::lit(const RayPoint& p, double mu_s) const {
  Shared<double> shared;
  return mu_s >= 0 || shared.sphere_discriminant(bottom_radius_, p.height, mu_s, 0) < 0;
}

// docs/theory (1.8).
// The shadow is the cylinder |p|^2 - (p . sun)^2 = R^2 behind the planet:
// (r0^2 - a^2 - R^2) + 2 s (r0 mu0 - a nu) + s^2 (1 - nu^2) = 0 with a = r0 mu_s0.
std::vector<double> SunAlongRay::shadow_edges() const {
  const double h = ray_.entry_height, a = radius_mu_s_;
  const double c = h * (2 * bottom_radius_ + h) - a * a;
  const double b = (bottom_radius_ + h) * ray_.entry_mu - a * nu_;
  const double q = 1 - nu_ * nu_;
  std::vector<double> edges;
  auto keep = [&](double s) {
    if (s > 0 && s < ray_.length && a + s * nu_ < 0) edges.push_back(s);
  };
  constexpr double kParallel = 1e-14;
  const double discriminant = b * b - q * c;
  if (q < kParallel) {
    if (b != 0) keep(-0.5 * c / b);
  } else if (discriminant > 0) {
    const double root = std::sqrt(discriminant);
    keep((-b - root) / q);
    keep((-b + root) / q);
  }
  return edges;
}

}  // namespace skyfit
