// SPDX-License-Identifier: Apache-2.0
// Blocks of a made-up planet without OpenGL.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <map>
#include <numbers>
#include <span>
#include <vector>

#include "render/gl/terrain/block_mesh.h"
#include "render/gl/terrain/planet_tree.h"
#include "render/gl/terrain/relief.h"

namespace skyfit {

inline constexpr double kEarth = 6360e3;
inline constexpr int kBlockSide = kBlockQuads + 1;

inline const Relief& relief() {
  static const Relief made(kEarth, {0.15, 0.15, 0.15, 0.15}, true);
  return made;
}

struct MadeBlock {
  std::vector<BlockVertex> vertices;
  HeightRange heights;
  glm::dvec3 centre;

  const BlockVertex& at(int column, int row) const {
    return vertices[static_cast<std::size_t>(row) * kBlockSide + column];
  }
  // Planet coordinates, metres.
  glm::dvec3 fine(const BlockVertex& v) const { return position(v.fine_km); }
  glm::dvec3 coarse(const BlockVertex& v) const { return position(v.coarse_km); }

 private:
  glm::dvec3 position(const std::array<float, 3>& km) const {
    return centre + 1e3 * glm::dvec3(km[0], km[1], km[2]);
  }
};

inline MadeBlock made_block(const CubeBlock& block) {
  MadeBlock made;
  made.vertices.resize(kBlockVertices);
  made.heights = make_block(block, relief(), kEarth, made.vertices).whole;
  made.centre = block_centre(block, kEarth);
  return made;
}

// Made once for a test.
inline const MadeBlock& stored_block(const CubeBlock& block) {
  static std::map<CubeBlock, MadeBlock> store;
  const auto found = store.find(block);
  return found != store.end() ? found->second
                              : store.emplace(block, made_block(block)).first->second;
}

inline std::vector<HeightRange> stored_heights(std::span<const CubeBlock> blocks) {
  std::vector<HeightRange> heights;
  for (const CubeBlock& block : blocks) heights.push_back(stored_block(block).heights);
  return heights;
}

// The block that holds a direction: cube_direction() the other way round.
inline CubeBlock block_at(const glm::dvec3& direction, int level) {
  CubeBlock block{0, level, 0, 0};
  double best = -2;
  for (int face = 0; face < 6; ++face) {
    const double cosine = glm::dot(direction, cube_direction(face, 0, 0));
    if (cosine > best) best = cosine, block.face = face;
  }
  const auto count = std::int64_t{1} << level;
  const auto place = [&](double s, double t) {
    const glm::dvec3 out = cube_direction(block.face, 0, 0);
    // Of the direction in which s or t grows: 45 degrees off the middle where it is 1.
    const glm::dvec3 along = std::numbers::sqrt2 * cube_direction(block.face, s, t) - out;
    const double angle = std::atan2(glm::dot(direction, along), glm::dot(direction, out));
    const double unit = 0.5 + 2 * angle / std::numbers::pi;
    return std::clamp(static_cast<std::int64_t>(unit * static_cast<double>(count)), std::int64_t{0},
                      count - 1);
  };
  block.column = place(1, 0);
  block.row = place(0, 1);
  return block;
}

}  // namespace skyfit
