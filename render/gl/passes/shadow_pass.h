// SPDX-License-Identifier: Apache-2.0
// Depth seen from each sun, in up to three maps about the camera, each of a larger part of the
// terrain; see render/shaders/shadows.glsl.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "render/gl/context/objects.h"
#include "render/gl/context/uniform_block.h"
#include "render/gl/terrain/planet_tree.h"

namespace skyfit {

inline constexpr int kShadowMaps = 3;  // of a sun, at most

// An orthographic view along the sun's beam; the axes of the site, kilometres from the camera.
struct ShadowView {
  glm::dmat4 clip_from_site;       // x, y in -1..1, depth in 0..1 away from the sun
  std::vector<glm::dvec4> planes;  // of what may cast a shadow into it, metres, as in TerrainView
  double half_km;
};

// The maps that hold, from the finest on: those whose texels are so small that what stands up to
// `highest_m` above the bottom radius can shade what is looked up kShadowOffTexels off the ground.
// None for a camera far away. `ground_distance_m`: of the camera from the ground below.
std::vector<ShadowView> shadow_views(const glm::dvec3& sun, double ground_distance_m,
                                     double highest_m);

// How far off a plane a place is looked up, in texels of its map, so that the plane does not shade
// it. The farthest depth that is compared lies 0.75 texels aside (the corners of sunlit()) and 1
// more (the filter), along both axes, and with the beam at an angle a to the plane's normal is
// nearer to the sun by that times tan(a), which the offset t outweighs by t / cos(a).
inline constexpr double kShadowOffTexels = 1.75 * 1.41421356;

class ShadowPass {
 public:
  // Calls draw(i) for the first `maps` with the map i as the depth target.
  void draw(std::size_t maps, const std::function<void(std::size_t)>& draw);

  // The maps as texture `unit`, and what render/shaders/shadows.glsl needs of the views: those of
  // the first sun, then as many of the next.
  void bind(std::span<const ShadowView> views, std::size_t suns, GLuint program, GLuint unit,
            UniformBuffers& buffers) const;

 private:
  void make_room(std::size_t maps);

  GlTexture maps_;
  std::size_t room_ = 0;  // maps that it can hold
};

}  // namespace skyfit
