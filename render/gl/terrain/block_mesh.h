// SPDX-License-Identifier: Apache-2.0
// The vertices of one block of the planet: its own shape and, for geomorphing, that of the block
// one level coarser. Positions are relative to the block's centre, so that they keep their digits
// in single precision at every distance.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/gl/terrain/ground.h"
#include "render/gl/terrain/planet_tree.h"

namespace skyfit {

// Planet axes.
struct BlockVertex {
  std::array<float, 3> fine_km, coarse_km;
  std::array<std::int16_t, 4> fine_normal, coarse_normal;  // / 32767; fourth: Ground::rock()
  std::array<std::uint16_t, 4> fine_reflectance, coarse_reflectance;  // / 65535
  // Elevation::above_water_m, fine and coarse, / 32767 of the largest amount in the block.
  std::array<std::int16_t, 2> above_water;
};

// 33 x 33, rows of growing u first, then the skirt: the border once more, let down,
// counterclockwise from (0, 0).
inline constexpr int kBlockVertices = (kBlockQuads + 1) * (kBlockQuads + 1) + 4 * kBlockQuads;

// What is drawn or left out of a block: 4 x 4 quads and what hangs from them of the skirt. Patches
// are numbered in rows of growing u; their outlines are those of the blocks three levels below.
inline constexpr int kPatchesPerSide = 8;
inline constexpr int kPatches = kPatchesPerSide * kPatchesPerSide;

// Where all vertices of a patch have become the coarser shape, every second one lies on the
// triangles of the others: the patch is drawn without them, but for those on the sides of
// neighbours that keep theirs.
enum PatchSide : unsigned {
  kLeftSide = 1,  // u = 0
  kRightSide = 2,
  kLowerSide = 4,  // v = 0
  kUpperSide = 8,
};
inline constexpr std::size_t kPatchShapes = 17;
inline constexpr std::size_t kWholePatch = 0;
constexpr std::size_t coarse_patch(unsigned whole_sides) { return 1 + whole_sides; }

// Triangles of every block, counterclockwise from outside: of each shape patch by patch.
struct BlockIndices {
  std::vector<std::uint16_t> indices;
  // Where each patch begins; the last is the end.
  std::array<std::array<std::uint32_t, kPatches + 1>, kPatchShapes> patches;
};
const BlockIndices& block_indices();

// The middle of the block on the sphere of the bottom radius, planet coordinates, metres.
glm::dvec3 block_centre(const CubeBlock& block, double radius_m);

// Of the vertices of both shapes.
struct BlockHeights {
  HeightRange whole;                          // with the skirt
  std::array<HeightRange, kPatches> patches;  // without it
};

// `out` has kBlockVertices. A block of level 0 has no coarser shape: both are the same.
BlockHeights make_block(const CubeBlock& block, const Ground& ground, double radius_m,
                        std::span<BlockVertex> out);

}  // namespace skyfit
