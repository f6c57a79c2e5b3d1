// SPDX-License-Identifier: Apache-2.0
// The shape and colour of a planet's ground. Planet coordinates: z to the north pole, x to latitude
// 0, longitude 0, y to longitude 90 degrees east.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "model/base/content_cache.h"
#include "model/tables/tables.h"

namespace skyfit {

struct Elevation {
  double height_m;       // of the ground or of the water over it, above the bottom radius, >= 0
  double above_water_m;  // water where it is <= 0; continuous, and about linear across a coast
};

class Ground {
 public:
  virtual ~Ground() = default;

  // `direction`: unit vector; details smaller than `resolution_m` are left out.
  virtual Elevation elevation(const glm::dvec3& direction, double resolution_m) const = 0;
  double height_m(const glm::dvec3& direction, double resolution_m) const {
    return elevation(direction, resolution_m).height_m;
  }

  // Lambert reflectance of dry ground at the four nodes of the colour rule, in 0..1. `steepness` =
  // 1 - cos of the slope's angle.
  virtual NodeValues reflectance(const glm::dvec3& direction, double height_m, double steepness,
                                 double resolution_m) const = 0;

  // Of the light that comes out of water; without a value it is reflectance().
  virtual std::optional<NodeValues> water_reflectance() const = 0;

  // Share of the second material of dry ground, rock, in 0..1.
  virtual double rock(const glm::dvec3& direction, double height_m, double steepness,
                      double resolution_m) const = 0;

  virtual double highest_m() const = 0;  // a bound on height_m()

  // All that the answers above follow from.
  virtual void add_inputs(CacheKey& key) const = 0;
};

}  // namespace skyfit
