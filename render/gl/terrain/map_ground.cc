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

constexpr double kFinest = 0.1;  // no detail below, m

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

Elevation MapGround::elevation(const glm::dvec3& direction, double resolution_m) const {
  const double resolution = std::max(resolution_m, kFinest);
  const PlanetMap::Sample sample = heights_->at(direction, resolution / radius_m_);
  const double range = highest_m_ - lowest_m_;
  const double height = lowest_m_ + range * sample.value.x;
  const double detail = detail_m(scale(), direction * radius_m_, range * sample.slope,
                                 height - water_level_m_, resolution);
  const double bed = height + detail;
  return {std::max({bed, lowest_m_, water_level_m_}),
          above_water_m(bed - water_level_m_, lowest_m_ < water_level_m_, scale(),
                        range * sample.slope, resolution)};
}

std::optional<NodeValues> MapGround::water_reflectance() const {
  return colors_ ? std::nullopt : std::optional(kWater);
}

NodeValues MapGround::reflectance(const glm::dvec3& direction, double height_m, double steepness,
                                  double resolution_m) const {
  if (colors_) return colors_->reflectance(direction, resolution_m / radius_m_);
  return mix(kSoil, kRock, rock(direction, height_m, steepness, resolution_m));
}

double MapGround::rock(const glm::dvec3& direction, double height_m, double steepness,
                       double resolution_m) const {
  // Steep slopes, and the upper part of the land; the line between them is not a contour.
  const double range = std::max(highest_m_ - water_level_m_, 1.0);
  const double spots = fractal_noise(direction * radius_m_, 1500, std::max(resolution_m, kFinest));
  const double high = smoothstep(0.2, 0.5, (height_m - water_level_m_) / range + 0.05 * spots);
  return std::max(high, smoothstep(0.04, 0.14, steepness));
}

double MapGround::highest_m() const {
  return std::max(highest_m_ + most_detail_m(scale()), water_level_m_);
}

MapScale MapGround::scale() const {
  return {heights_->texel_angle() * radius_m_, highest_m_ - lowest_m_};
}

}  // namespace skyfit
