// SPDX-License-Identifier: Apache-2.0
// A smooth function on the sphere from a picture of it: cubic B-splines between the texels, two
// continuous derivatives, without seams at the edges of the picture. Never outside the range of the
// texels; a ramp stays a ramp. Coarser copies of the picture answer where details are left out.
#pragma once

#include <filesystem>
#include <glm/vec3.hpp>
#include <memory>

#include "model/base/content_cache.h"

namespace skyfit {

class PlanetMap {
 public:
  enum class Values {
    kHeights,  // the first channel, 0..1 from the darkest texel to the brightest
    kColors,   // linear sRGB; integers in the file are sRGB coded, floats are linear
  };

  struct Sample {
    glm::dvec3 value;  // kHeights: x, the others 0
    double slope;      // of kHeights: change per texel, smoothed over its neighbours
  };

  virtual ~PlanetMap() = default;

  // `direction`: unit vector in planet coordinates. Details smaller than `angle`, in radians, are
  // left out.
  virtual Sample at(const glm::dvec3& direction, double angle) const = 0;

  // Between neighbouring texels, in radians.
  virtual double texel_angle() const = 0;

  // All that the answers above follow from.
  virtual void add_inputs(CacheKey& key) const = 0;
};

// Throws as inspect_map() and read_map() do. A texel takes as many bytes as in the file, a third
// more for the coarser copies; heights at least two.
std::unique_ptr<PlanetMap> read_planet_map(const std::filesystem::path& file,
                                           PlanetMap::Values values);

}  // namespace skyfit
