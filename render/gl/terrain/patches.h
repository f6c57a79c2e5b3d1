// SPDX-License-Identifier: Apache-2.0
// Which patches of a view's blocks are worth drawing, those within its bounds that no nearer ground
// hides, and which of them at half the resolution. From a camera above it the ground is a surface
// without holes, so along one azimuth what lies lower, as the camera sees it, than some nearer
// ground is behind it: the highest slope of the ground so far, azimuth by azimuth, is a horizon
// that rises from near to far.
#pragma once

#include <bitset>
#include <limits>
#include <span>
#include <vector>

#include "render/gl/terrain/block_mesh.h"
#include "render/gl/terrain/planet_tree.h"

namespace skyfit {

// Patches to draw, as block_mesh.h numbers them.
using PatchSet = std::bitset<kPatches>;

struct MeasuredBlock {
  CubeBlock block;
  BlockHeights heights;
  double morphed_m;  // distance from the camera from which its vertices are the coarser shape's
};

struct BlockPatches {
  PatchSet seen;    // empty where nothing of the block is
  PatchSet coarse;  // all their vertices have become the coarser shape
  double nearest_m = std::numeric_limits<double>::infinity();  // no point of what is seen is nearer
};

// Of each block. Views with `planes`, which are no camera's, have no horizon. Never leaves out what
// can be seen; may keep what cannot.
std::vector<BlockPatches> choose_patches(const TerrainView& view,
                                         std::span<const MeasuredBlock> blocks);

// How a coarse patch of a block is drawn beside its neighbours.
std::size_t shape_of(std::size_t patch, const PatchSet& coarse);

}  // namespace skyfit
