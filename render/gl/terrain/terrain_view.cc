// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/terrain_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace skyfit {
namespace {

constexpr double kLargestRatio = kLargestLodConstant / kBlockQuads,
                 kSmallestRatio = kLeastLodConstant / kBlockQuads;
// A view from above holds fewer levels of the tree, so that each can be finer for the same number
// of blocks; that from 2 m holds this many.
constexpr double kLevelsFromGround = 19;
constexpr int kFewestLevels = 9;

int levels_of(double radius_m) {
  int levels = kFewestLevels;
  while (block_arc_m(levels, radius_m) / kBlockQuads > kFinestQuad) ++levels;
  return levels;
}

}  // namespace

double horizon_m(double radius_m, double height_m) {
  return std::sqrt(height_m * (2 * radius_m + height_m));
}

TerrainView terrain_view(const FrameOptions& options, const SiteAxes& axes, const Ground& ground,
                         double radius_m, double ground_distance_m) {
  const double aspect = static_cast<double>(options.width) / options.height;
  TerrainView view;
  view.axes = axes;
  view.altitude_m = options.camera.altitude_m;
  view.basis = view_basis(options.camera);
  const double tall = std::tan(0.5 * options.camera.vertical_fov);
  view.tangent = {tall * aspect, tall};
  view.radius_m = radius_m;
  view.highest_m = ground.highest_m();
  const double sample = 2 * tall / (options.height * options.samples_per_side);
  const double height = std::max(ground_distance_m, 2.0);
  const double horizon = horizon_m(radius_m, height) + horizon_m(radius_m, view.highest_m);
  const double levels = 2 + std::log2(std::max(horizon / height, 1.0));
  const double finer = std::sqrt(kLevelsFromGround / std::min(levels, kLevelsFromGround));
  view.split_ratio = std::clamp(finer / (kBlockQuads * options.samples_per_quad * sample),
                                kSmallestRatio, kLargestRatio);
  view.levels = options.terrain.levels.value_or(levels_of(radius_m));
  view.cull = options.terrain.cull;
  if (const auto& constant = options.terrain.lod_constant) {
    view.split_ratio = *constant / kBlockQuads;
    view.fixed = true;
  }
  return view;
}

void bend(const glm::vec4& eye_in_air, TerrainView& view) {
  const double radius = eye_in_air.x, refractivity = eye_in_air.z, scale = eye_in_air.w;
  if (!(refractivity > 0)) return;
  // Near the ground light turns by kappa of the planet's curvature.
  constexpr double kMost = 0.99, kRoom = 1.05;
  const double kappa = std::min(refractivity * radius / scale, kMost);
  view.farther = kRoom / std::sqrt(1 - kappa);
  // Level rays from the ground to space, and the same again past it.
  view.most_lift =
      2 * view.farther * refractivity * std::sqrt(0.5 * std::numbers::pi * radius / scale);
}

std::vector<BlockSelection> affordable_blocks(TerrainView& view, std::span<const Planes> others,
                                              BlockStore& store) {
  const HeightsOf heights_of = [&](std::span<const CubeBlock> blocks) {
    store.provide(blocks);
    std::vector<HeightRange> heights;
    for (const CubeBlock& block : blocks) heights.push_back(store.heights(block).whole);
    return heights;
  };
  for (;;) {
    store.begin_frame();
    try {
      std::vector<BlockSelection> selections = {select_blocks(view, heights_of)};
      TerrainView other = view;
      other.cull = true;
      for (const Planes& planes : others) {
        other.planes = planes;
        selections.push_back(select_blocks(other, heights_of));
      }
      return selections;
    } catch (const std::length_error&) {
      if (view.fixed)
        throw std::invalid_argument(fmt::format(
            "render.terrain.lod_constant = {:.9g}: must be smaller, or levels fewer, for "
            "at most {} blocks",
            view.split_ratio * kBlockQuads, BlockStore::kMostBlocks));
      if (view.split_ratio <= kSmallestRatio) throw;
      view.split_ratio = std::max(0.8 * view.split_ratio, kSmallestRatio);
    }
  }
}

}  // namespace skyfit
