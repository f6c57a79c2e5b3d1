// SPDX-License-Identifier: Apache-2.0
// The boxes about a view's blocks as lines, which stand in the scene and face the sun.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <span>

#include "render/gl/terrain/color_reflectance.h"
#include "render/gl/terrain/object_mesh.h"
#include "render/gl/terrain/planet_tree.h"
#include "render/render.h"

namespace skyfit {

// What is drawn of a selection and of what it left out.
struct BoxedBlocks {
  std::span<const MeasuredNode> drawn;  // with their heights
  const BlockSelection& selection;
};

// Linear sRGB: of a drawn block by its level, six in turn.
glm::dvec3 level_color(int level);

// Twelve lines of each box, without what the bottom sphere hides (two indices a piece), in
// kilometres from the camera `camera_m` above the bottom radius, along the axes of the view's site.
// `sun`: unit vector along them.
// BlockColors::kLevel: those of drawn blocks; kCulling: theirs green, of nodes outside the frustum
// red, of nodes behind the horizon blue.
ObjectMesh block_boxes(const BoxedBlocks& blocks, const TerrainView& view, double camera_m,
                       BlockColors colors, const glm::dvec3& sun, const ColorReflectance& color);

}  // namespace skyfit
