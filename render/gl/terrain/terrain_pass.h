// SPDX-License-Identifier: Apache-2.0
// The planet's ground in the G-buffer: writes colour, normal and reflectance, depth. Also its depth
// alone, as a light sees it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "render/gl/context/objects.h"
#include "render/gl/passes/projection.h"
#include "render/gl/passes/site_axes.h"
#include "render/gl/terrain/block_store.h"
#include "render/gl/terrain/patches.h"
#include "render/gl/terrain/planet_tree.h"

namespace skyfit {

// Blocks ready to be drawn, relative to a camera.
struct TerrainDraw {
  GlBuffer instances, commands, indices;  // of each block one
  int blocks = 0, hidden = 0;             // in part or as a whole; with no patch that is seen
  std::int64_t triangles = 0;
  double nearest_m = 0;  // nothing of it is nearer to the camera
};

class TerrainPass {
 public:
  // `ground` and `cache`, which may be null, outlive the pass.
  TerrainPass(const Ground& ground, double radius_m, ContentCache* cache);

  BlockStore& store() { return store_; }

  // The visible patches of blocks in the store, in place of what `draw` held.
  void prepare(std::span<const CubeBlock> blocks, const TerrainView& view, TerrainDraw& draw) const;

  void draw(const TerrainDraw& draw, const Projection& projection, const SiteAxes& axes) const;

  // `clip_from_planet`: of positions relative to the camera, planet axes, km.
  void draw_depth(const TerrainDraw& draw, const glm::mat4& clip_from_planet) const;

 private:
  void submit(const TerrainDraw& draw) const;

  double radius_m_;
  std::optional<NodeValues> water_reflectance_;
  BlockStore store_;
  GlProgram program_, depth_program_;
  GlVertexArray layout_;
};

}  // namespace skyfit
