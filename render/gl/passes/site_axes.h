// SPDX-License-Identifier: Apache-2.0
// The camera frame of render.h (z up at the camera, x toward the sun's azimuth, y to the left of
// it) in planet coordinates (ground.h).
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "render/render.h"

namespace skyfit {

struct SiteAxes {
  glm::dvec3 x, y, z;  // orthonormal

  glm::dmat3 planet_from_site() const { return {x, y, z}; }
  glm::dmat3 site_from_planet() const { return glm::transpose(planet_from_site()); }
};

inline SiteAxes site_axes(const Site& site) {
  const double sl = std::sin(site.latitude), cl = std::cos(site.latitude);
  const double so = std::sin(site.longitude), co = std::cos(site.longitude);
  const glm::dvec3 up(cl * co, cl * so, sl), north(-sl * co, -sl * so, cl), east(-so, co, 0);
  const glm::dvec3 sun = std::cos(site.sun_azimuth) * north + std::sin(site.sun_azimuth) * east;
  return {sun, glm::cross(up, sun), up};
}

}  // namespace skyfit
