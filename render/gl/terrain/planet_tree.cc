// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/planet_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;

// Outward, and the directions in which columns and rows run: right-handed seen from outside.
struct FaceAxes {
  glm::dvec3 out, along, across;
};
constexpr std::array<FaceAxes, 6> kFaces = {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                             {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
                                             {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
                                             {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                                             {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},
                                             {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}}};

double distance_between(const Box& box, const glm::dvec3& p) {
  return glm::length(glm::max(glm::max(box.low - p, p - box.high), glm::dvec3(0)));
}

enum class Visibility { kSeen, kOutside, kBehind };

// Corners, middles of the edges and the middle: unit vectors in some frame's axes.
using BlockPoints = std::array<glm::dvec3, 9>;

BlockPoints block_points(const CubeBlock& block, const glm::dmat3& frame_from_planet) {
  BlockPoints points;
  block_directions(block, 2, points);
  for (glm::dvec3& point : points) point = frame_from_planet * point;
  return points;
}

Box box_of(const BlockPoints& points, int level, const HeightRange& heights, double radius_m) {
  Box box{glm::dvec3(1e300), glm::dvec3(-1e300)};
  for (const glm::dvec3& direction : points) {
    for (const double r : {radius_m + heights.low, radius_m + heights.high}) {
      box.low = glm::min(box.low, r * direction);
      box.high = glm::max(box.high, r * direction);
    }
  }
  // The sphere bulges between these points by less than the arrow of the arc between two of them;
  // sqrt(2) for the diagonal, and for the faces' corners.
  const double half_step = std::min(block_arc_m(level, 1) * std::numbers::sqrt2 * 0.25, 1.0);
  const double bulge = 1.1 * (radius_m + heights.high) * (1 - std::cos(half_step));
  box.low -= bulge;
  box.high += bulge;
  return box;
}

// What a view can see, in the axes of its site about the planet's centre.
class Frustum {
 public:
  explicit Frustum(const TerrainView& view)
      : view_(view),
        frame_from_planet_(view.axes.site_from_planet()),
        camera_(0, 0, view.radius_m + view.altitude_m),
        own_horizon_(horizon(view.altitude_m)),
        planes_(view.bounds()) {}

  const glm::dvec3& camera() const { return camera_; }

  BlockPoints points(const CubeBlock& block) const {
    return block_points(block, frame_from_planet_);
  }

  Visibility visibility(const BlockPoints& points, int level, const HeightRange& heights) const {
    if (behind(points, level, heights.high)) return Visibility::kBehind;
    return outside(box_of(points, level, heights, view_.radius_m)) ? Visibility::kOutside
                                                                   : Visibility::kSeen;
  }

 private:
  // Angle at the centre from a point to where its view touches the bottom sphere.
  double horizon(double height) const {
    return std::acos(view_.radius_m / (view_.radius_m + std::max(height, 0.0)));
  }

  // Outside a plane is a box whose farthest corner along the plane's normal, its p-vertex, is.
  bool outside(const Box& box) const {
    return std::any_of(planes_.begin(), planes_.end(), [&](const glm::dvec4& plane) {
      const glm::dvec3 normal(plane);
      const glm::dvec3 p = glm::mix(box.low, box.high, glm::greaterThan(normal, glm::dvec3(0)));
      return glm::dot(normal, p - camera_) + plane.w < 0;
    });
  }

  // A peak is seen as far as its own horizon reaches beyond the camera's.
  bool behind(const BlockPoints& points, int level, double highest) const {
    const glm::dvec3 up(0, 0, 1);
    const double angle = 2 * std::asin(std::min(0.5 * glm::distance(points[4], up), 1.0));
    // Arcs are longest along a face's middle lines.
    const double radius = 0.5 * std::numbers::sqrt2 * block_arc_m(level, 1);
    return angle - radius > view_.farther * (own_horizon_ + horizon(highest));
  }

  const TerrainView& view_;
  glm::dmat3 frame_from_planet_;
  glm::dvec3 camera_;
  double own_horizon_;
  std::vector<glm::dvec4> planes_;
};

class Selector {
 public:
  Selector(const TerrainView& view, const HeightsOf& heights_of)
      : view_(view), heights_of_(heights_of), frustum_(view) {}

  BlockSelection select() {
    std::vector<Node> nodes;
    for (int face = 0; face < 6; ++face)
      nodes.push_back(node({face, 0, 0, 0}, {0, view_.highest_m}));
    while (!nodes.empty()) nodes = next_level(std::move(nodes));
    std::stable_sort(found_.begin(), found_.end(),
                     [](const Found& a, const Found& b) { return a.distance < b.distance; });
    for (const Found& found : found_) selection_.blocks.push_back(found.block);
    return std::move(selection_);
  }

 private:
  struct Node {
    CubeBlock block;
    HeightRange heights;
    BlockPoints points;
  };
  struct Found {
    double distance;
    CubeBlock block;
  };

  Node node(const CubeBlock& block, const HeightRange& heights) const {
    return {block, heights, frustum_.points(block)};
  }

  void drop_unseen(std::vector<Node>& nodes) {
    if (!view_.cull) return;
    std::erase_if(nodes, [&](const Node& node) {
      const Visibility seen = frustum_.visibility(node.points, node.block.level, node.heights);
      if (seen == Visibility::kBehind) selection_.behind.push_back({node.block, node.heights});
      if (seen == Visibility::kOutside) selection_.outside.push_back({node.block, node.heights});
      return seen != Visibility::kSeen;
    });
  }

  // First with the heights that the parent allows, then with the block's own.
  std::vector<Node> next_level(std::vector<Node> nodes) {
    drop_unseen(nodes);
    std::vector<CubeBlock> blocks;
    for (const Node& node : nodes) blocks.push_back(node.block);
    const std::vector<HeightRange> heights = heights_of_(blocks);
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i].heights = heights[i];
    drop_unseen(nodes);
    std::vector<Node> children;
    for (const Node& node : nodes) {
      const CubeBlock& block = node.block;
      const double arc = block_arc_m(block.level, view_.radius_m);
      // Finer details stand up to a quad out of these heights.
      const double margin = arc / kBlockQuads;
      const HeightRange allowed{node.heights.low - margin, node.heights.high + margin};
      const double distance = distance_between(
          box_of(node.points, block.level, allowed, view_.radius_m), frustum_.camera());
      if (block.level + 1 >= view_.levels || distance >= view_.split_ratio * arc) {
        found_.push_back({distance, block});
        continue;
      }
      for (const auto& [column, row] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
        children.push_back(this->node(
            {block.face, block.level + 1, 2 * block.column + column, 2 * block.row + row},
            allowed));
      }
    }
    return children;
  }

  const TerrainView& view_;
  const HeightsOf& heights_of_;
  Frustum frustum_;
  std::vector<Found> found_;
  BlockSelection selection_;
};

}  // namespace

glm::dvec3 cube_direction(int face, double s, double t) {
  const FaceAxes& axes = kFaces[static_cast<std::size_t>(face)];
  double along = std::tan(0.25 * kPi * s), across = std::tan(0.25 * kPi * t);
  // Where the neighbouring face is in front, the lines of its own grid go on.
  if (std::abs(s) > 1) {
    across *= std::abs(along);
  } else if (std::abs(t) > 1) {
    along *= std::abs(across);
  }
  return glm::normalize(axes.out + along * axes.along + across * axes.across);
}

glm::dvec3 block_direction(const CubeBlock& block, double u, double v) {
  const double size = std::ldexp(2.0, -block.level);
  return cube_direction(block.face, (static_cast<double>(block.column) + u) * size - 1,
                        (static_cast<double>(block.row) + v) * size - 1);
}

void block_directions(const CubeBlock& block, int parts, std::span<glm::dvec3> out) {
  const FaceAxes& axes = kFaces[static_cast<std::size_t>(block.face)];
  const double side = std::ldexp(2.0, -block.level);
  const auto tangent = [&](std::int64_t place, int part) {
    const double along = static_cast<double>(place) + static_cast<double>(part) / parts;
    return std::tan(0.25 * kPi * (along * side - 1));
  };
  const auto columns = static_cast<std::size_t>(parts + 1);
  // The first row holds the columns' directions until it is its turn.
  for (int column = 0; column <= parts; ++column)
    out[static_cast<std::size_t>(column)] = axes.out + tangent(block.column, column) * axes.along;
  for (int row = parts; row >= 0; --row) {
    const glm::dvec3 across = tangent(block.row, row) * axes.across;
    for (std::size_t column = 0; column < columns; ++column)
      out[static_cast<std::size_t>(row) * columns + column] = glm::normalize(out[column] + across);
  }
}

double block_arc_m(int level, double radius_m) { return std::ldexp(0.5 * kPi * radius_m, -level); }

std::vector<glm::dvec4> TerrainView::bounds() const {
  if (!planes.empty()) return planes;
  const auto& [right, up, forward] = basis;
  const auto widened = [&](double t) {
    return most_lift > 0 ? std::tan(std::min(std::atan(t) + most_lift, 1.5)) : t;
  };
  const double w = widened(tangent.x), h = widened(tangent.y);
  std::vector<glm::dvec4> frustum;
  for (const glm::dvec3& inward :
       {forward * w + right, forward * w - right, forward * h + up, forward * h - up, forward}) {
    frustum.emplace_back(glm::normalize(inward), 0);
  }
  return frustum;
}

Box block_box(const CubeBlock& block, const HeightRange& heights,
              const glm::dmat3& frame_from_planet, double radius_m) {
  return box_of(block_points(block, frame_from_planet), block.level, heights, radius_m);
}

BlockSelection select_blocks(const TerrainView& view, const HeightsOf& heights_of) {
  return Selector(view, heights_of).select();
}

}  // namespace skyfit
