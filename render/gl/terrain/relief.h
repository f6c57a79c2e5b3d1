// SPDX-License-Identifier: Apache-2.0
// The shape and colour of a made-up planet: seas, plains, hills and mountain ranges from 3D noise.
// Features scale with the planet; lengths named below are those on a planet of 6360 km. The relief
// fades into a plain at one place on a coast, so that a camera 1 m above the bottom radius there is
// above the ground on every planet.
#pragma once

#include <glm/vec3.hpp>

#include "render/gl/passes/site_axes.h"
#include "render/gl/terrain/ground.h"

namespace skyfit {

class Relief final : public Ground {
 public:
  // Without a sea the basins are plains below the land, and nothing grows: dust, rock and no snow.
  // `albedo` at the nodes of the colour rule.
  Relief(double bottom_radius_m, const NodeValues& ground_albedo, bool sea);

  // The sun's azimuth is that of the water.
  const SiteAxes& coast() const { return coast_; }

  Elevation elevation(const glm::dvec3& direction, double resolution_m) const override;

  // The mean over the planet, with its water, and the nodes is that of the ground albedo; the
  // colours are those of sea, plants, rock and snow where the albedo has none.
  NodeValues reflectance(const glm::dvec3& direction, double height_m, double steepness,
                         double resolution_m) const override;
  std::optional<NodeValues> water_reflectance() const override { return water_; }
  double rock(const glm::dvec3& direction, double height_m, double steepness,
              double resolution_m) const override;
  double highest_m() const override;
  void add_inputs(CacheKey& key) const override;

 private:
  void settle_on_a_coast();
  // Relative reflectances.
  NodeValues material(const glm::dvec3& direction, double height_m, double steepness,
                      double resolution_m) const;
  NodeValues dry_material(const glm::dvec3& direction, double steepness, double resolution_m) const;
  NodeValues reflectance_of(const NodeValues& material) const;
  void balance_materials();

  double radius_m_;
  NodeValues albedo_;
  bool sea_;
  double scale_;  // this planet's radius / 6360 km
  SiteAxes coast_;
  NodeValues brightness_{1, 1, 1, 1};  // reflectance of land over the relative one
  NodeValues water_{};                 // reflectance of the sea
};

}  // namespace skyfit
