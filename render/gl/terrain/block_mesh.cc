// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/block_mesh.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace skyfit {
namespace {

constexpr int kSide = kBlockQuads + 1;
constexpr int kSkirt = 4 * kBlockQuads;
constexpr int kPatchQuads = kBlockQuads / kPatchesPerSide;

// Column and row of the border's vertices, counterclockwise.
std::pair<int, int> border(int i) {
  constexpr int n = kBlockQuads;
  const int along = i % n;
  switch (i / n) {
    case 0:
      return {along, 0};
    case 1:
      return {n, along};
    case 2:
      return {n - along, n};
    default:
      return {0, n - along};
  }
}

// What a vertex shows, in double precision.
struct Point {
  glm::dvec3 position, normal;  // position relative to the block's centre, metres
  double height, above_water, rock;
  NodeValues reflectance;
};

Point middle(const Point& a, const Point& b) {
  Point m{0.5 * (a.position + b.position), glm::normalize(a.normal + b.normal),
          0.5 * (a.height + b.height),     0.5 * (a.above_water + b.above_water),
          0.5 * (a.rock + b.rock),         {}};
  for (std::size_t k = 0; k < 4; ++k)
    m.reflectance[k] = 0.5 * (a.reflectance[k] + b.reflectance[k]);
  return m;
}

// The square [u0, u1] x [v0, v1] of a block as quads x quads, with the details that such a grid can
// show.
class Grid {
 public:
  Grid(const CubeBlock& block, int quads, double spacing_m, const Ground& ground, double radius_m,
       const glm::dvec3& centre)
      : quads_(quads), stride_(quads + 3) {
    const double resolution = 2 * spacing_m;
    // One more around, for the normals.
    const auto count = static_cast<std::size_t>(stride_) * stride_;
    directions_.resize(count);
    elevations_.resize(count);
    positions_.resize(count);
    for (int row = -1; row <= quads + 1; ++row) {
      for (int column = -1; column <= quads + 1; ++column) {
        const std::size_t i = index(column, row);
        directions_[i] = block_direction(block, static_cast<double>(column) / quads,
                                         static_cast<double>(row) / quads);
        elevations_[i] = ground.elevation(directions_[i], resolution);
        positions_[i] = (radius_m + elevations_[i].height_m) * directions_[i] - centre;
      }
    }
    points_.reserve(static_cast<std::size_t>(quads + 1) * (quads + 1));
    for (int row = 0; row <= quads; ++row) {
      for (int column = 0; column <= quads; ++column) {
        points_.push_back(point(column, row, ground, resolution));
      }
    }
  }

  const Point& at(int column, int row) const {
    return points_[static_cast<std::size_t>(row) * (quads_ + 1) + column];
  }

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row + 1) * stride_ + (column + 1);
  }

  Point point(int column, int row, const Ground& ground, double resolution) const {
    const std::size_t i = index(column, row);
    const glm::dvec3 along =
        positions_[index(column + 1, row)] - positions_[index(column - 1, row)];
    const glm::dvec3 across =
        positions_[index(column, row + 1)] - positions_[index(column, row - 1)];
    const glm::dvec3 normal = glm::normalize(glm::cross(along, across));
    const double steepness = 1 - std::max(glm::dot(normal, directions_[i]), 0.0);
    const auto [height, above_water] = elevations_[i];
    return {positions_[i],
            normal,
            height,
            above_water,
            ground.rock(directions_[i], height, steepness, resolution),
            ground.reflectance(directions_[i], height, steepness, resolution)};
  }

  int quads_, stride_;
  std::vector<glm::dvec3> directions_, positions_;
  std::vector<Elevation> elevations_;
  std::vector<Point> points_;
};

// A point of the parent's triangles, whose diagonals run from (1, 0) to (0, 1) of a quad.
Point on_coarse(const Grid& coarse, int column, int row) {
  const int c = column / 2, r = row / 2;
  const bool odd_column = column % 2 != 0, odd_row = row % 2 != 0;
  if (odd_column && odd_row) return middle(coarse.at(c + 1, r), coarse.at(c, r + 1));
  if (odd_column) return middle(coarse.at(c, r), coarse.at(c + 1, r));
  if (odd_row) return middle(coarse.at(c, r), coarse.at(c, r + 1));
  return coarse.at(c, r);
}

void pack(const Point& point, std::array<float, 3>& position, std::array<std::int16_t, 4>& normal,
          std::array<std::uint16_t, 4>& reflectance) {
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    position[i] = static_cast<float>(1e-3 * point.position[k]);
    normal[i] = static_cast<std::int16_t>(std::lround(32767 * point.normal[k]));
  }
  normal[3] = static_cast<std::int16_t>(std::lround(32767 * std::clamp(point.rock, 0.0, 1.0)));
  for (std::size_t k = 0; k < 4; ++k) {
    reflectance[k] =
        static_cast<std::uint16_t>(std::lround(65535 * std::clamp(point.reflectance[k], 0.0, 1.0)));
  }
}

void widen(HeightRange& range, const HeightRange& other) {
  range.low = std::min(range.low, other.low);
  range.high = std::max(range.high, other.high);
}

// A quad's patch.
int patch_at(int column, int row) {
  return row / kPatchQuads * kPatchesPerSide + column / kPatchQuads;
}

using Indices = std::vector<std::uint16_t>;

// A triangle whose first two sides may have another vertex in their middle, -1 where they have not.
void add_triangle(std::array<int, 3> corners, int in_first, int in_second, Indices& out) {
  const auto [a, b, c] = corners;
  std::vector<int> outline = {a, b, c};
  if (in_second >= 0) outline.insert(outline.begin() + 2, in_second);
  if (in_first >= 0) outline.insert(outline.begin() + 1, in_first);
  // A streams about a vertex in a side, so that no triangle is a line.
  const int middle = in_first >= 0 ? in_first : in_second >= 0 ? in_second : a;
  std::ranges::rotate(outline, std::ranges::find(outline, middle));
  for (std::size_t i = 1; i + 1 < outline.size(); ++i) {
    for (const int vertex : {outline[0], outline[i], outline[i + 1]})
      out.push_back(static_cast<std::uint16_t>(vertex));
  }
}

// The quads of a patch, `step` of the block's on a side; of those along the whole sides the
// vertices between, too.
void add_quads(int patch, int step, unsigned whole_sides, Indices& out) {
  const int first_column = patch % kPatchesPerSide * kPatchQuads;
  const int first_row = patch / kPatchesPerSide * kPatchQuads;
  const int end_column = first_column + kPatchQuads, end_row = first_row + kPatchQuads;
  const auto at = [](int column, int row) { return row * kSide + column; };
  for (int row = first_row; row < end_row; row += step) {
    for (int column = first_column; column < end_column; column += step) {
      const int right = column + step, upper = row + step, half = step / 2;
      const auto middle = [&](unsigned side, bool along_it, int c, int r) {
        return along_it && (whole_sides & side) != 0 ? at(c, r) : -1;
      };
      const int b = at(right, row), c = at(column, upper);
      add_triangle({c, at(column, row), b},
                   middle(kLeftSide, column == first_column, column, row + half),
                   middle(kLowerSide, row == first_row, column + half, row), out);
      add_triangle({b, at(right, upper), c},
                   middle(kRightSide, right == end_column, right, row + half),
                   middle(kUpperSide, upper == end_row, column + half, upper), out);
    }
  }
}

// What hangs from a patch.
void add_skirt(int patch, int step, Indices& out) {
  for (int i = 0; i < kSkirt; i += step) {
    const int next = (i + step) % kSkirt;
    const auto [column, row] = border(i);
    const auto [next_column, next_row] = border(next);
    if (patch != patch_at(std::min({column, next_column, kBlockQuads - 1}),
                          std::min({row, next_row, kBlockQuads - 1})))
      continue;
    const int a = row * kSide + column, b = next_row * kSide + next_column;
    const int below_a = kSide * kSide + i, below_b = kSide * kSide + next;
    add_triangle({a, below_a, b}, -1, -1, out);
    add_triangle({b, below_a, below_b}, -1, -1, out);
  }
}

BlockIndices make_indices() {
  BlockIndices made;
  for (std::size_t shape = 0; shape < kPatchShapes; ++shape) {
    const int step = shape == kWholePatch ? 1 : 2;
    const unsigned whole_sides = shape == kWholePatch ? 0 : static_cast<unsigned>(shape - 1);
    for (int patch = 0; patch < kPatches; ++patch) {
      made.patches[shape][static_cast<std::size_t>(patch)] =
          static_cast<std::uint32_t>(made.indices.size());
      add_quads(patch, step, whole_sides, made.indices);
      add_skirt(patch, step, made.indices);
    }
    made.patches[shape][kPatches] = static_cast<std::uint32_t>(made.indices.size());
  }
  return made;
}

}  // namespace

const BlockIndices& block_indices() {
  static const BlockIndices made = make_indices();
  return made;
}

glm::dvec3 block_centre(const CubeBlock& block, double radius_m) {
  return radius_m * block_direction(block, 0.5, 0.5);
}

BlockHeights make_block(const CubeBlock& block, const Ground& ground, double radius_m,
                        std::span<BlockVertex> out) {
  const double spacing = block_arc_m(block.level, radius_m) / kBlockQuads;
  const glm::dvec3 centre = block_centre(block, radius_m);
  const Grid fine(block, kBlockQuads, spacing, ground, radius_m, centre);
  // The part of the parent that the block covers, as the parent shows it.
  const bool has_parent = block.level > 0;
  const Grid coarse(block, has_parent ? kBlockQuads / 2 : 1, 2 * spacing, ground, radius_m, centre);
  BlockHeights heights;
  heights.patches.fill({1e300, -1e300});
  std::vector<std::array<double, 2>> above_water;
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      BlockVertex& vertex = out[static_cast<std::size_t>(row) * kSide + column];
      const Point& own = fine.at(column, row);
      pack(own, vertex.fine_km, vertex.fine_normal, vertex.fine_reflectance);
      const Point parents = has_parent ? on_coarse(coarse, column, row) : own;
      pack(parents, vertex.coarse_km, vertex.coarse_normal, vertex.coarse_reflectance);
      above_water.push_back({own.above_water, parents.above_water});
      const auto [low, high] = std::minmax(own.height, parents.height);
      // On a border it belongs to the patches on both sides.
      for (const int c : {std::max(column - 1, 0), std::min(column, kBlockQuads - 1)}) {
        for (const int r : {std::max(row - 1, 0), std::min(row, kBlockQuads - 1)})
          widen(heights.patches[static_cast<std::size_t>(patch_at(c, r))], {low, high});
      }
    }
  }
  double largest = 1e-300;
  for (const auto& [own, parents] : above_water)
    largest = std::max({largest, std::abs(own), std::abs(parents)});
  for (std::size_t i = 0; i < above_water.size(); ++i) {
    for (std::size_t k = 0; k < 2; ++k)
      out[i].above_water[k] =
          static_cast<std::int16_t>(std::lround(32767 * above_water[i][k] / largest));
  }
  // Deep enough for the cracks that rounding leaves along the border.
  const double depth_km = 1e-3 * 0.25 * spacing;
  for (int i = 0; i < kSkirt; ++i) {
    const auto [column, row] = border(i);
    BlockVertex vertex = out[static_cast<std::size_t>(row) * kSide + column];
    const glm::dvec3 up = block_direction(block, static_cast<double>(column) / kBlockQuads,
                                          static_cast<double>(row) / kBlockQuads);
    for (int k = 0; k < 3; ++k) {
      const auto drop = static_cast<float>(depth_km * up[k]);
      vertex.fine_km[static_cast<std::size_t>(k)] -= drop;
      vertex.coarse_km[static_cast<std::size_t>(k)] -= drop;
    }
    out[static_cast<std::size_t>(kSide * kSide + i)] = vertex;
  }
  heights.whole = heights.patches[0];
  for (const HeightRange& patch : heights.patches) widen(heights.whole, patch);
  heights.whole.low -= 1e3 * depth_km;
  return heights;
}

}  // namespace skyfit
