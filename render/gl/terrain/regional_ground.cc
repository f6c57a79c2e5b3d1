// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/regional_ground.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <stdexcept>
#include <utility>

namespace skyfit {
namespace {

constexpr double kFinest = 0.1;  // no detail below, m
// The weight of a map beyond its edge, which counts where no other map is.
constexpr double kLeastShare = 1e-6;
// How far water lies below its surface, and land at least above it, where a region goes over into
// its surroundings, m. Little, so that no water lies on the slope between them.
constexpr double kShallow = 0.1;

}  // namespace

RegionalMaps read_regional_maps(const Scene& scene, double bottom_radius_m, bool has_sea) {
  std::vector<RegionalMap> maps;
  std::int64_t left = kMostDemCells;
  for (const RegionalDem& dem : scene.dems) {
    maps.emplace_back(scene, dem, bottom_radius_m, left);
    left -= maps.back().cells();
    if (has_sea || maps.back().lowest_m() >= 0) continue;
    throw std::runtime_error(fmt::format(
        "{}: heights down to {:.6g} m on a planet without a sea: expected none below 0 m, or a map "
        "of all heights (--height-map) with --water-level-m below them",
        dem.file.string(), maps.back().lowest_m()));
  }
  std::ranges::stable_sort(maps, {}, [](const RegionalMap& map) { return map.scale().texel_m; });
  return std::make_shared<const std::vector<RegionalMap>>(std::move(maps));
}

RegionalGround::RegionalGround(std::unique_ptr<Ground> planet, RegionalMaps maps,
                               const Scene& scene, double bottom_radius_m)
    : planet_(std::move(planet)),
      maps_(std::move(maps)),
      surroundings_(scene.dem_surroundings),
      water_level_m_(scene.water_level_m),
      radius_m_(bottom_radius_m) {}

Elevation RegionalGround::elevation(const glm::dvec3& direction, double resolution_m) const {
  const double resolution = std::max(resolution_m, kFinest);
  const GeographicPlace place = place_of(direction);
  double height = 0, above_water = 0, shares = 0, left = 1, presence = 0;
  for (const RegionalMap& map : *maps_) {
    const auto sample = map.at(place, resolution);
    if (!sample) continue;
    const double share = left * std::max(sample->inside, kLeastShare * sample->presence);
    const double bed =
        sample->height_m + detail_m(map.scale(), direction * radius_m_, sample->slope_m,
                                    sample->height_m - water_level_m_, resolution);
    height += share * bed;
    above_water += share * above_water_m(bed - water_level_m_, map.lowest_m() < water_level_m_,
                                         map.scale(), sample->slope_m, resolution);
    shares += share;
    left *= 1 - sample->inside;
    presence = std::max(presence, sample->presence);
    if (left <= 0) break;
  }
  const auto around = [&]() -> Elevation {
    if (surroundings_ == DemSurroundings::kSea) return {water_level_m_, -kShallow};
    return planet_->elevation(direction, resolution_m);
  };
  if (shares <= 0) return around();
  Elevation mixed{height / shares, above_water / shares};
  if (presence < 1) {
    const Elevation other = around();
    const double above =
        other.above_water_m > 0 ? std::max(other.height_m - water_level_m_, kShallow) : -kShallow;
    mixed = {std::lerp(other.height_m, mixed.height_m, presence),
             std::lerp(above, mixed.above_water_m, presence)};
  }
  mixed.height_m = std::max({mixed.height_m, water_level_m_, 0.0});
  return mixed;
}

std::optional<NodeValues> RegionalGround::water_reflectance() const {
  return planet_->water_reflectance();
}

NodeValues RegionalGround::reflectance(const glm::dvec3& direction, double height_m,
                                       double steepness, double resolution_m) const {
  return planet_->reflectance(direction, height_m, steepness, resolution_m);
}

double RegionalGround::rock(const glm::dvec3& direction, double height_m, double steepness,
                            double resolution_m) const {
  return planet_->rock(direction, height_m, steepness, resolution_m);
}

double RegionalGround::highest_m() const {
  double highest = planet_->highest_m();
  for (const RegionalMap& map : *maps_)
    highest = std::max(highest, map.highest_m() + most_detail_m(map.scale()));
  return highest;
}

void RegionalGround::add_inputs(CacheKey& key) const {
  key.text("regions").value(radius_m_).value(water_level_m_).value(surroundings_);
  planet_->add_inputs(key);
  for (const RegionalMap& map : *maps_) map.add_inputs(key);
}

}  // namespace skyfit
