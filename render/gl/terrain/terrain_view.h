// SPDX-License-Identifier: Apache-2.0
// How finely the planet is drawn: near the ground a quad spans FrameOptions::samples_per_quad
// samples of the picture, but no block is split beyond 50 times its size; 9 levels and, near the
// camera, as many more as show details of a third of a metre. TerrainOptions say otherwise.
#pragma once

#include "render/gl/passes/site_axes.h"
#include "render/gl/terrain/block_store.h"
#include "render/gl/terrain/ground.h"
#include "render/gl/terrain/planet_tree.h"
#include "render/render.h"

namespace skyfit {

inline constexpr double kFinestQuad = 0.3;  // m

// Distance to where a view from the height touches the bottom sphere.
double horizon_m(double radius_m, double height_m);

// `ground_distance_m`: of the camera, downward.
TerrainView terrain_view(const FrameOptions& options, const SiteAxes& axes, const Ground& ground,
                         double radius_m, double ground_distance_m);

// Makes room in the view for what an eye sees by refraction; Projection::eye_in_air.
void bend(const glm::vec4& eye_in_air, TerrainView& view);

// The blocks of a view and then, as fine, of what each of the other bounds holds
// (TerrainView::planes), in the store as a new frame's; where all together are more than memory
// should hold, the view is made coarser. Throws std::length_error when even the coarsest has too
// many, std::invalid_argument when a view of a fixed constant has.
using Planes = std::vector<glm::dvec4>;
std::vector<BlockSelection> affordable_blocks(TerrainView& view, std::span<const Planes> others,
                                              BlockStore& store);

}  // namespace skyfit
