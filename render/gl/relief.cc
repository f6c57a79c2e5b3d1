// SPDX-License-Identifier: Apache-2.0
#include "render/gl/relief.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "render/gl/noise.h"

namespace skyfit {
namespace {

constexpr double kEarthRadius = 6360e3;
constexpr double kMountainHeight = 4200;
constexpr double kHillHeight = 260;
constexpr double kPlainHeight = 25;
constexpr double kRoughness = 0.3;  // of the plain at the site
constexpr double kFinest = 0.1;     // no detail below, m

double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

NodeValues mix(const NodeValues& a, const NodeValues& b, double t) {
  NodeValues r;
  for (std::size_t k = 0; k < 4; ++k) r[k] = a[k] + t * (b[k] - a[k]);
  return r;
}

// Relative reflectances at about 460, 530, 590 and 660 nm; only their ratios matter.
constexpr NodeValues kSea = {0.62, 0.50, 0.36, 0.30};
constexpr NodeValues kGrass = {0.42, 0.95, 0.82, 0.66};
constexpr NodeValues kSteppe = {0.85, 1.35, 1.60, 1.70};
constexpr NodeValues kRock = {1.15, 1.30, 1.42, 1.50};
constexpr NodeValues kSnow = {5.2, 5.2, 5.1, 5.0};

double land_value(const glm::dvec3& p, double resolution) {
  return fractal_noise(p + glm::dvec3(1.7e6), 5.2e6, std::max(resolution, 2e3)) + 0.02;
}

glm::dvec3 fibonacci_direction(int index, int count) {
  const double z = 1 - (2 * index + 1.0) / count;
  const double turn = index * std::numbers::pi * (3 - std::sqrt(5.0));
  const double s = std::sqrt(1 - z * z);
  return {s * std::cos(turn), s * std::sin(turn), z};
}

}  // namespace

Relief::Relief(double bottom_radius_m, double ground_albedo)
    : radius_m_(bottom_radius_m), albedo_(ground_albedo), scale_(bottom_radius_m / kEarthRadius) {
  // A coast with mountains on the horizon.
  z_ = glm::normalize(glm::dvec3(0.48, -0.31, 0.82));
  x_ = glm::normalize(glm::cross(z_, glm::dvec3(0.2, 0.9, 0.1)));
  y_ = glm::cross(z_, x_);
  balance_materials();
}

double Relief::height_m(const glm::dvec3& direction, double resolution_m) const {
  const double resolution = std::max(resolution_m / scale_, kFinest);
  const glm::dvec3 p = direction * kEarthRadius;
  const double distance = glm::length(direction - z_) * kEarthRadius;
  const double fading = smoothstep(200, 14e3, distance);
  const double roughness = kRoughness * (1 + fractal_noise(p, 9, resolution)) * 0.5;
  const double land = smoothstep(-0.01, 0.10, land_value(p, resolution));
  const double inland = std::max(land, 1 - smoothstep(20e3, 120e3, distance));
  if (inland <= 0) return 0;
  const double range = fractal_noise(p + glm::dvec3(0, 9e6, 0), 9e5, std::max(resolution, 2e4));
  const double near_site = 1 - smoothstep(60e3, 300e3, distance);
  const double mountains = std::max(smoothstep(-0.05, 0.55, range), 0.55 * near_site);
  double height = kPlainHeight * (1 + fractal_noise(p, 30e3, resolution));
  height += kHillHeight * (0.6 + fractal_noise(p + glm::dvec3(4e5), 7e3, resolution));
  height += kMountainHeight * mountains * ridged_noise(p, 36e3, resolution);
  return std::max(fading * inland * height, 0.0) + roughness * inland;
}

NodeValues Relief::material(const glm::dvec3& direction, double height_m, double steepness,
                            double resolution_m) const {
  const double resolution = std::max(resolution_m / scale_, kFinest);
  const glm::dvec3 p = direction * kEarthRadius;
  const double patches =
      fractal_noise(p + glm::dvec3(2e5, 0, 7e5), 2.4e6, std::max(resolution, 30e3));
  const double spots = fractal_noise(p, 1500, resolution);
  const double grain = fractal_noise(p + glm::dvec3(50), 3, resolution);
  NodeValues soil = mix(kGrass, kSteppe, smoothstep(-0.5, 0.5, patches + 0.35 * spots));
  soil = mix(soil, kRock, smoothstep(1100, 2300, height_m + 500 * spots));
  soil = mix(soil, kRock, smoothstep(0.06, 0.22, steepness));
  const double snow =
      smoothstep(2500, 3100, height_m + 400 * spots) * (1 - smoothstep(0.15, 0.4, steepness));
  soil = mix(soil, kSnow, snow);
  for (double& value : soil) value *= 1 + 0.18 * grain + 0.12 * spots;
  return mix(kSea, soil, smoothstep(0.0, 0.05, height_m));
}

NodeValues Relief::reflectance(const glm::dvec3& direction, double height_m, double steepness,
                               double resolution_m) const {
  NodeValues value = material(direction, height_m, steepness, resolution_m);
  for (std::size_t k = 0; k < 4; ++k) {
    value[k] = std::clamp(albedo_ * (1 + contrast_ * (value[k] / mean_[k] - 1)), 0.0, 1.0);
  }
  return value;
}

void Relief::balance_materials() {
  constexpr int kDirections = 4000;
  constexpr double kResolution = 2e3;
  NodeValues sum{}, highest{};
  for (int i = 0; i < kDirections; ++i) {
    const glm::dvec3 direction = fibonacci_direction(i, kDirections);
    const double height = height_m(direction, kResolution * scale_);
    const NodeValues value = material(direction, height, 0, kResolution * scale_);
    for (std::size_t k = 0; k < 4; ++k) {
      sum[k] += value[k];
      highest[k] = std::max(highest[k], value[k]);
    }
  }
  for (std::size_t k = 0; k < 4; ++k) {
    mean_[k] = sum[k] / kDirections;
    // No material above 1: a bright planet has less contrast.
    const double excess = 1.5 * highest[k] / mean_[k] - 1;
    contrast_ = std::min(contrast_, (1 - albedo_) / std::max(albedo_ * excess, 1e-9));
  }
}

}  // namespace skyfit
