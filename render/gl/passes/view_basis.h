// SPDX-License-Identifier: Apache-2.0
// The camera's axes in the camera frame of render.h (z up, x toward the sun, y to the left of it).
#pragma once

#include <cmath>
#include <glm/vec3.hpp>

#include "render/render.h"

namespace skyfit {

struct ViewBasis {
  glm::dvec3 right, up, forward;  // orthonormal
};

inline ViewBasis view_basis(const Camera& camera) {
  const double sz = std::sin(camera.view_zenith), cz = std::cos(camera.view_zenith);
  const double sa = std::sin(camera.azimuth), ca = std::cos(camera.azimuth);
  return {{-sa, -ca, 0}, {-cz * ca, cz * sa, sz}, {sz * ca, -sz * sa, cz}};
}

}  // namespace skyfit
