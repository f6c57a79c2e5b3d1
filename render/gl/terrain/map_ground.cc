// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/map_ground.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

#include "render/gl/terrain/blend.h"
#include "render/gl/terrain/noise.h"

namespace skyfit {
namespace {

// Absolute reflectances at about 440, 510, 560 and 630 nm, where there is no colour map.
constexpr NodeValues kWater = {0.045, 0.035, 0.025, 0.020};
constexpr NodeValues kSoil = {0.060, 0.095, 0.125, 0.150};
constexpr NodeValues kRock = {0.130, 0.150, 0.165, 0.180};

constexpr double kFinest = 0.1;       // no detail below, m
constexpr double kLongestDetail = 3;  // texels: what the map's splines still show
constexpr double kDetailSlope = 0.3;  // of every octave of the noise, as a share of the map's
constexpr double kMostDetail = 0.05;  // of the map's range of heights
constexpr double kOctaves = 2.1;      // a bound on the sum of octaves of amplitudes 1, 1/2, ...
constexpr double kRoughness = 0.12;   // of flat land, m, at waves of kRough
constexpr double kRough = 9;

}  // namespace

ColorMap::ColorMap(const std::filesystem::path& file, const ColorRule& rule)
    : map_(read_planet_map(file, PlanetMap::Values::kColors)), rule_(rule), colors_(rule) {}

NodeValues ColorMap::reflectance(const glm::dvec3& direction, double angle) const {
  return colors_.at(map_->at(direction, angle).value);
}

void ColorMap::add_inputs(CacheKey& key) const {
  map_->add_inputs(key);
  key.value(rule_);
}

MapGround::MapGround(const Scene& scene, double bottom_radius_m, const ColorRule& rule)
    : radius_m_(bottom_radius_m),
      lowest_m_(scene.lowest_m),
      highest_m_(scene.highest_m),
      water_level_m_(scene.water_level_m),
      heights_(read_planet_map(scene.height_map, PlanetMap::Values::kHeights)) {
  if (!scene.color_map.empty()) colors_ = std::make_unique<ColorMap>(scene.color_map, rule);
}

void MapGround::add_inputs(CacheKey& key) const {
  key.text("map").value(radius_m_).value(lowest_m_).value(highest_m_).value(water_level_m_);
  heights_->add_inputs(key);
  if (colors_) colors_->add_inputs(key);
}

double MapGround::height_m(const glm::dvec3& direction, double resolution_m) const {
  const double resolution = std::max(resolution_m, kFinest);
  const PlanetMap::Sample sample = heights_->at(direction, resolution / radius_m_);
  const double range = highest_m_ - lowest_m_;
  const double height = lowest_m_ + range * sample.value.x;
  const double detail =
      detail_m(direction, range * sample.slope, height - water_level_m_, resolution);
  return std::max({height + detail, lowest_m_, water_level_m_});
}

// `slope`: of the map, m per texel. Under water there is no roughness of flat land, so that a sea
// that the map shows as flat stays one.
double MapGround::detail_m(const glm::dvec3& direction, double slope, double above_water_m,
                           double resolution_m) const {
  const double longest = kLongestDetail * heights_->texel_angle() * radius_m_;
  const glm::dvec3 p = direction * radius_m_;
  double detail = 0;
  const double amplitude =
      std::min(kDetailSlope * kLongestDetail * slope, kMostDetail * (highest_m_ - lowest_m_));
  if (amplitude > 0) detail += amplitude * fractal_noise(p, longest, resolution_m);
  const double dry = smoothstep(0, 1, above_water_m);
  if (dry > 0 && resolution_m < 2 * kRough && kRough < longest)
    detail += dry * kRoughness * fractal_noise(p + glm::dvec3(31), kRough, resolution_m);
  return detail;
}

NodeValues MapGround::reflectance(const glm::dvec3& direction, double height_m, double steepness,
                                  double resolution_m) const {
  if (colors_) return colors_->reflectance(direction, resolution_m / radius_m_);
  const double stone = rock(direction, height_m, steepness, resolution_m);
  return stone < 0 ? kWater : mix(kSoil, kRock, stone);
}

double MapGround::rock(const glm::dvec3& direction, double height_m, double steepness,
                       double resolution_m) const {
  if (height_m <= water_level_m_) return -1;
  // Steep slopes, and the upper part of the land; the line between them is not a contour.
  const double range = std::max(highest_m_ - water_level_m_, 1.0);
  const double spots = fractal_noise(direction * radius_m_, 1500, std::max(resolution_m, kFinest));
  const double high = smoothstep(0.2, 0.5, (height_m - water_level_m_) / range + 0.05 * spots);
  return std::max(high, smoothstep(0.04, 0.14, steepness));
}

double MapGround::highest_m() const {
  const double detail = kOctaves * (kMostDetail * (highest_m_ - lowest_m_) + kRoughness);
  return std::max(highest_m_ + detail, water_level_m_);
}

}  // namespace skyfit
