// SPDX-License-Identifier: Apache-2.0
// What every pass knows of the camera. Infinite reversed projection: depth = near / distance along
// the view axis, which in a float is as precise far away as it is near.
#pragma once

#include <cmath>
#include <glm/glm.hpp>

#include "render/gl/passes/view_basis.h"

namespace skyfit {

struct Projection {
  glm::mat3 view_from_site;
  glm::vec2 tangent;  // of half the field of view
  float near_km;
  // Where rays are bent by air: the planet's radius and the eye's height, km, n - 1 of the air at
  // the ground, and the height over which it falls by e, km; else zeros.
  glm::vec4 eye_in_air;
};

// Nothing nearer is drawn, km.
inline constexpr float kNearKm = 1e-4f;

inline Projection make_projection(const Camera& camera, double aspect,
                                  const glm::vec4& eye_in_air = glm::vec4(0)) {
  const ViewBasis basis = view_basis(camera);
  const double tall = std::tan(0.5 * camera.vertical_fov);
  return {glm::mat3(glm::transpose(glm::dmat3(basis.right, basis.up, -basis.forward))),
          glm::vec2(tall * aspect, tall), kNearKm, eye_in_air};
}

}  // namespace skyfit
