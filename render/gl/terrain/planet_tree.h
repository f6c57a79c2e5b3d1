// SPDX-License-Identifier: Apache-2.0
// The planet as a cube of six quadtrees, normalised to a sphere: which blocks a view needs
// (Sperlhofer 2011, 4.3). Planet coordinates of ground.h, metres.
//
// A block is split while its distance from the camera is less than `split_ratio` times its arc
// length. The distance is that to the block's axis-aligned box, so no vertex of a block is nearer,
// and with a ratio of at least 1.8 neighbours differ by one level at most: a vertex that has become
// one of the coarser level at split_ratio times that level's arc length meets its neighbour's.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "render/gl/passes/site_axes.h"
#include "render/gl/passes/view_basis.h"

namespace skyfit {

inline constexpr int kBlockQuads = 32;  // along a side: 33 x 33 vertices

struct CubeBlock {
  int face = 0, level = 0;           // +x, -x, +y, -y, +z, -z; level 0 is the whole face
  std::int64_t column = 0, row = 0;  // 0 .. 2^level - 1
  auto operator<=>(const CubeBlock&) const = default;
};

// Unit vector. s and t run from -1 to 1 over a face, in equal angles along its middle lines; a
// little beyond an edge are the places that the face there has in the same distance from it.
glm::dvec3 cube_direction(int face, double s, double t);

// The same of a block; u and v run from 0 to 1.
glm::dvec3 block_direction(const CubeBlock& block, double u, double v);

// The same at the corners of parts x parts equal parts of a block, rows of growing u first; `out`
// has (parts + 1)^2.
void block_directions(const CubeBlock& block, int parts, std::span<glm::dvec3> out);

// Length of the arc that a block's middle line spans.
double block_arc_m(int level, double radius_m);

struct Box {
  glm::dvec3 low, high;
};

// Heights above the bottom radius, metres.
struct HeightRange {
  double low, high;
};

// Holds every point of the block within the heights, along the axes of a frame with the planet's
// centre as its origin.
Box block_box(const CubeBlock& block, const HeightRange& heights,
              const glm::dmat3& frame_from_planet, double radius_m);

struct TerrainView {
  SiteAxes axes;  // boxes stand along them: upright at the camera
  double altitude_m = 2;
  ViewBasis basis;
  glm::dvec2 tangent;  // of half the field of view, horizontal and vertical
  double radius_m = 6360e3, highest_m = 9e3;
  double split_ratio = 50;  // >= 1.8
  int levels = 9;           // >= 1
  bool fixed = false;       // the ratio is not to be made smaller
  bool cull = true;
  // Where rays are bent by air (bend()): by how much farther than along straight ones a horizon is,
  // and the most by which something is seen higher, radians.
  double farther = 1, most_lift = 0;
  // What is seen instead of the picture's frustum, when there are any: normals that point inward
  // and distances from the camera, in the axes of the site.
  std::vector<glm::dvec4> planes;

  glm::dvec3 camera() const { return (radius_m + altitude_m) * axes.z; }  // planet coordinates

  // What bounds it: `planes` or those of the picture's frustum, in the same form.
  std::vector<glm::dvec4> bounds() const;
};

// A node of the tree and the heights between which its ground is known to lie.
struct MeasuredNode {
  CubeBlock block;
  HeightRange heights;
};

struct BlockSelection {
  std::vector<CubeBlock> blocks;              // near to far
  std::vector<MeasuredNode> outside, behind;  // culled: outside the frustum, behind the horizon
};

// Heights of the blocks' vertices, which it may have to make first.
using HeightsOf = std::function<std::vector<HeightRange>(std::span<const CubeBlock>)>;

// Throws what `heights_of` throws.
BlockSelection select_blocks(const TerrainView& view, const HeightsOf& heights_of);

}  // namespace skyfit
