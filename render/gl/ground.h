// SPDX-License-Identifier: Apache-2.0
// What the terrain is made from: heights and materials of the whole planet, by direction from its
// centre.
#pragma once

#include <glm/vec3.hpp>

#include "model/tables.h"

namespace skyfit {

class Ground {
 public:
  virtual ~Ground() = default;

  // Height above the bottom radius in metres, >= 0. `direction`: unit vector in planet coordinates
  // (z = north pole, x = latitude 0, longitude 0, y = longitude 90 degrees east); details smaller
  // than `resolution_m` are left out.
  virtual double height_m(const glm::dvec3& direction, double resolution_m) const = 0;

  // Lambert reflectance at the four nodes of the colour rule, in 0..1. `steepness` = 1 - cos of the
  // slope's angle.
  virtual NodeValues reflectance(const glm::dvec3& direction, double height_m, double steepness,
                                 double resolution_m) const = 0;

  // Share of the second material (rock), 0..1; water has neither: -1.
  virtual double rock(const glm::dvec3& direction, double height_m, double steepness,
                      double resolution_m) const = 0;

  // A bound on height_m().
  virtual double highest_m() const = 0;
};

}  // namespace skyfit
