// SPDX-License-Identifier: Apache-2.0
// The ground of a real planet, from a map of its heights and one of its colours; see Scene in
// render.h and MapLayout in map_file.h. What is finer than the height map is noise that is rougher
// where the map is steeper.
#pragma once

#include <memory>

#include "render/gl/terrain/color_reflectance.h"
#include "render/gl/terrain/ground.h"
#include "render/gl/terrain/map_detail.h"
#include "render/gl/terrain/planet_map.h"
#include "render/render.h"

namespace skyfit {

// A colour map taken as the ground's reflectance.
class ColorMap {
 public:
  // Throws std::runtime_error in one line when the file is no map.
  ColorMap(const std::filesystem::path& file, const ColorRule& rule);

  // Details smaller than `angle`, in radians, are left out.
  NodeValues reflectance(const glm::dvec3& direction, double angle) const;

  void add_inputs(CacheKey& key) const;

 private:
  std::unique_ptr<PlanetMap> map_;
  ColorRule rule_;
  ColorReflectance colors_;
};

class MapGround final : public Ground {
 public:
  // The scene has a height map. Throws std::runtime_error in one line when a file is no map.
  MapGround(const Scene& scene, double bottom_radius_m, const ColorRule& rule);

  Elevation elevation(const glm::dvec3& direction, double resolution_m) const override;
  NodeValues reflectance(const glm::dvec3& direction, double height_m, double steepness,
                         double resolution_m) const override;
  // None where there is a colour map, which shows the water, too.
  std::optional<NodeValues> water_reflectance() const override;
  double rock(const glm::dvec3& direction, double height_m, double steepness,
              double resolution_m) const override;
  double highest_m() const override;
  void add_inputs(CacheKey& key) const override;

 private:
  MapScale scale() const;

  double radius_m_, lowest_m_, highest_m_, water_level_m_;
  std::unique_ptr<PlanetMap> heights_;
  std::unique_ptr<ColorMap> colors_;  // may be null
};

}  // namespace skyfit
