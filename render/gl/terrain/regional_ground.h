// SPDX-License-Identifier: Apache-2.0
// A planet's ground with the heights of regions in it, see Scene::dems in render.h. Where maps
// overlap, the one with the finer cells shows; where they adjoin, they go over into each other.
// Colours and materials are those that the planet has at such heights and slopes.
#pragma once

#include <memory>
#include <vector>

#include "render/gl/terrain/ground.h"
#include "render/gl/terrain/regional_map.h"
#include "render/render.h"

namespace skyfit {

// The scene's, the finest first; they do not depend on the atmosphere. Throws std::runtime_error in
// one line that names the file: as DemModule::read(), and for ground below the bottom radius of a
// planet whose basins are dry.
using RegionalMaps = std::shared_ptr<const std::vector<RegionalMap>>;
RegionalMaps read_regional_maps(const Scene& scene, double bottom_radius_m, bool has_sea);

class RegionalGround final : public Ground {
 public:
  // `planet`: what is around the maps.
  RegionalGround(std::unique_ptr<Ground> planet, RegionalMaps maps, const Scene& scene,
                 double bottom_radius_m);

  Elevation elevation(const glm::dvec3& direction, double resolution_m) const override;
  NodeValues reflectance(const glm::dvec3& direction, double height_m, double steepness,
                         double resolution_m) const override;
  std::optional<NodeValues> water_reflectance() const override;
  double rock(const glm::dvec3& direction, double height_m, double steepness,
              double resolution_m) const override;
  double highest_m() const override;
  void add_inputs(CacheKey& key) const override;

 private:
  std::unique_ptr<Ground> planet_;
  RegionalMaps maps_;
  DemSurroundings surroundings_;
  double water_level_m_, radius_m_;
};

}  // namespace skyfit
