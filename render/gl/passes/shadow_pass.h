// SPDX-License-Identifier: Apache-2.0
// Depth seen from the sun, in three maps about the camera, each of a larger part of the terrain;
// see render/shaders/shadows.glsl.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "render/gl/context/objects.h"
#include "render/gl/context/uniform_block.h"
#include "render/gl/terrain/planet_tree.h"

namespace skyfit {

inline constexpr int kShadowMaps = 3;

// An orthographic view along the sun's beam; the axes of the site, kilometres from the camera.
struct ShadowView {
  glm::dmat4 clip_from_site;       // x, y in -1..1, depth in 0..1 away from the sun
  std::vector<glm::dvec4> planes;  // of what may cast a shadow into it, metres, as in TerrainView
  double half_km;
};

// `ground_distance_m`: of the camera from the ground below.
std::array<ShadowView, kShadowMaps> shadow_views(const glm::dvec3& sun, double ground_distance_m);

class ShadowPass {
 public:
  ShadowPass();

  // Calls draw(i) with the map of the view i as the depth target.
  void draw(const std::function<void(int)>& draw) const;

  // The maps as texture `unit`, and what render/shaders/shadows.glsl needs of the views.
  void bind(const std::array<ShadowView, kShadowMaps>& views, GLuint program, GLuint unit,
            UniformBuffers& buffers) const;

 private:
  GlTexture maps_;
};

}  // namespace skyfit
