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
  Relief(double bottom_radius_m, double ground_albedo);

  // The sun's azimuth is that of the water.
  const SiteAxes& coast() const { return coast_; }

  double height_m(const glm::dvec3& direction, double resolution_m) const override;

  // Its mean over the planet is the ground albedo at every node.
  NodeValues reflectance(const glm::dvec3& direction, double height_m, double steepness,
                         double resolution_m) const override;
  double rock(const glm::dvec3& direction, double height_m, double steepness,
              double resolution_m) const override;
  double highest_m() const override;

 private:
  void settle_on_a_coast();
  NodeValues material(const glm::dvec3& direction, double height_m, double steepness,
                      double resolution_m) const;
  void balance_materials();

  double radius_m_, albedo_;
  double scale_;  // this planet's radius / 6360 km
  SiteAxes coast_;
  NodeValues mean_{1, 1, 1, 1};  // of material() over the planet
  double contrast_ = 1;          // 0: one colour, 1: the materials as they are
};

}  // namespace skyfit
