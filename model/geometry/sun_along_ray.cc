// SPDX-License-Identifier: Apache-2.0
#include "model/geometry/sun_along_ray.h"

#include <algorithm>
#include <cmath>

#include "model/shared/shared.h"

namespace skyfit {

// docs/theory (1.3) and (1.7).
SunAlongRay::SunAlongRay(double bottom_radius, const ViewRay& ray, const SkyPoint& point,
                         const LightTurns* turns)
    : bottom_radius_(bottom_radius), ray_(ray), turns_(turns) {
  const double sun_zenith =
      turns ? turns->apparent_zenith(point.altitude_m, point.sun_zenith) : point.sun_zenith;
  const double mu = std::cos(point.view_zenith), mu_s = std::cos(sun_zenith);
  nu_ = mu * mu_s +
        std::sin(point.view_zenith) * std::sin(sun_zenith) * std::cos(point.relative_azimuth);
  nu_ = std::clamp(nu_, -1.0, 1.0);
  up_ = std::sin(point.view_zenith) * mu_s -
        mu * std::sin(sun_zenith) * std::cos(point.relative_azimuth);
  right_ = std::sin(sun_zenith) * std::sin(point.relative_azimuth);
  sun_up_ = std::cos(point.sun_zenith);
  sun_forward_ = std::sin(point.sun_zenith) * std::cos(point.relative_azimuth);
  sun_right_ = std::sin(point.sun_zenith) * std::sin(point.relative_azimuth);
  height_ = point.altitude_m;
  view_zenith_ = point.view_zenith;
  radius_mu_s_ = (bottom_radius + point.altitude_m) * mu_s + ray.entry_distance * nu_;
}

// docs/theory (14.8).
// A straight ray turns about the planet by what its zenith angle loses, a refracted one by the
// bending between the two points more.
SunAlongRay::Local SunAlongRay::sun_at(const RayPoint& p) const {
  const double zenith = std::acos(std::clamp(p.mu, -1.0, 1.0));
  // At both points what light turns by that comes along the ray from beyond the air.
  const double turned = turns_->bending(height_, view_zenith_) - turns_->bending(p.height, zenith);
  const double around = view_zenith_ - zenith + turned;
  const double sine = std::sin(around), cosine = std::cos(around);
  return {cosine * sun_up_ + sine * sun_forward_, cosine * sun_forward_ - sine * sun_up_,
          sun_right_};
}

double SunAlongRay::nu(const RayPoint& p, double mu_s) const {
  if (!turns_) return nu_;
  const Local sun = sun_at(p);
  const double across = std::hypot(sun.forward, sun.right);
  const double cosine = across > 0 ? sun.forward / across : 1;
  return std::clamp(p.mu * mu_s + std::sqrt((1 - p.mu * p.mu) * (1 - mu_s * mu_s)) * cosine, -1.0,
                    1.0);
}

double SunAlongRay::beam_spread(const RayPoint& p, double mu_s) const {
  if (!turns_) return 1;
  const double index = turns_->refractive_index(height_);
  return index * index * turns_->beam_spread(p.height, std::acos(mu_s));
}

double SunAlongRay::mu_s(const RayPoint& p) const {
  if (turns_) {
    const double true_zenith = std::acos(std::clamp(sun_at(p).up, -1.0, 1.0));
    return std::cos(turns_->apparent_zenith(p.height, true_zenith));
  }
  return std::clamp((radius_mu_s_ + p.s * nu_) / (bottom_radius_ + p.height), -1.0, 1.0);
}

double SunAlongRay::cos_azimuth(const RayPoint& p, double mu_s) const {
  if (turns_) return azimuth(p, mu_s).cosine;
  const double sines = std::sqrt((1 - p.mu * p.mu) * (1 - mu_s * mu_s));
  constexpr double kVertical = 1e-9;  // there the series has no azimuth left: Lambda_lm ~ sin^m
  if (sines < kVertical) return 1;
  return std::clamp((nu_ - p.mu * mu_s) / sines, -1.0, 1.0);
}

// docs/theory (13.4).
SunAlongRay::Azimuth SunAlongRay::azimuth(const RayPoint& p, double mu_s) const {
  if (turns_) {
    const Local sun = sun_at(p);
    const double across = std::hypot(sun.forward, sun.right);
    return across > 0 ? Azimuth{sun.forward / across, sun.right / across} : Azimuth{};
  }
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
