// SPDX-License-Identifier: Apache-2.0
// Which patches of a view's blocks are worth drawing: those within its bounds that no nearer ground
// hides. From a camera above it the ground is a surface without holes, so along one azimuth what
// lies lower, as the camera sees it, than some nearer ground is behind it: the highest slope of the
// ground so far, azimuth by azimuth, is a horizon that rises from near to far.
#pragma once

#include <bitset>
#include <span>
#include <vector>

#include "render/gl/block_mesh.h"
#include "render/gl/planet_tree.h"

namespace skyfit {

// Patches to draw, as block_mesh.h numbers them.
using PatchSet = std::bitset<kPatches>;

struct MeasuredBlock {
  CubeBlock block;
  BlockHeights heights;
};

// One set for each block, empty where nothing of it is seen. Views with `planes`, which are no
// camera's, have no horizon. Never leaves out what can be seen; may keep what cannot.
std::vector<PatchSet> visible_patches(const TerrainView& view,
                                      std::span<const MeasuredBlock> blocks);

}  // namespace skyfit
