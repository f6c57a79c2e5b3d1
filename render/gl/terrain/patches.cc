// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/patches.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>

namespace skyfit {
namespace {

constexpr int kCornersPerSide = kPatchesPerSide + 1;

// An azimuth in place of the angle, which takes longer to find: along a square that stands on its
// corner, 4 in a full turn; half to once as fast as the angle in radians.
constexpr double kFullTurn = 4;
double turn_of(const glm::dvec2& direction) {
  const double along = direction.x / (std::abs(direction.x) + std::abs(direction.y));
  return direction.y >= 0 ? 1 - along : 3 + along;
}

// The same azimuth, at most half a turn from another one.
double turn_near(double about, double turn) {
  if (turn - about > 0.5 * kFullTurn) return turn - kFullTurn;
  return turn - about < -0.5 * kFullTurn ? turn + kFullTurn : turn;
}

// A patch as the camera sees it: metres, in the site's axes about the camera. Nothing of
// its surface lies beyond these bounds.
struct Outline {
  float nearest = 0, farthest = 0;  // horizontally; nearest = 0: may be around the camera
  double from = 0, to = 0;          // turns of its corners
  double reach = 0;                 // by how much its sides may bulge out of them or in
  double lowest = 0, highest = 0;   // slopes: height above the camera's by horizontal distance
};

// The corners of a block's patches.
class Corners {
 public:
  Corners(const TerrainView& view, const CubeBlock& block, const glm::dmat3& site_from_planet)
      : radius_m_(view.radius_m), camera_m_(view.radius_m + view.altitude_m) {
    block_directions(block, kPatchesPerSide, directions_);
    for (std::size_t i = 0; i < directions_.size(); ++i) {
      directions_[i] = site_from_planet * directions_[i];
      turns_[i] = turn_of(glm::dvec2(directions_[i]));
    }
  }

  // Of a patch: four, counterclockwise.
  std::array<std::size_t, 4> of(std::size_t patch) const {
    const int column = static_cast<int>(patch) % kPatchesPerSide;
    const int row = static_cast<int>(patch) / kPatchesPerSide;
    return {index(column, row), index(column + 1, row), index(column + 1, row + 1),
            index(column, row + 1)};
  }

  // Relative to the camera.
  glm::dvec3 at(std::size_t corner, double height) const {
    return (radius_m_ + height) * directions_[corner] - glm::dvec3(0, 0, camera_m_);
  }
  double turn(std::size_t corner) const { return turns_[corner]; }

 private:
  static std::size_t index(int column, int row) {
    return static_cast<std::size_t>(row * kCornersPerSide + column);
  }

  double radius_m_, camera_m_;
  std::array<glm::dvec3, kCornersPerSide * kCornersPerSide> directions_;
  std::array<double, kCornersPerSide * kCornersPerSide> turns_;
};

// By how much a patch bulges out of the chords between its corners.
double bulge_m(const CubeBlock& block, double radius_m) {
  const double arc = block_arc_m(block.level, 1) / kPatchesPerSide;
  return 1.1 * radius_m * (1 - std::cos(std::min(0.5 * std::numbers::sqrt2 * arc, 1.0)));
}

using PatchPoints = std::array<glm::dvec3, 8>;  // the corners at the lowest and the highest height

PatchPoints points_of(std::size_t patch, const Corners& corners, const HeightRange& heights) {
  PatchPoints points;
  std::size_t filled = 0;
  for (const std::size_t corner : corners.of(patch)) {
    points[filled++] = corners.at(corner, heights.low);
    points[filled++] = corners.at(corner, heights.high);
  }
  return points;
}

bool outside(std::span<const glm::dvec4> bounds, const PatchPoints& points, double bulge) {
  return std::ranges::any_of(bounds, [&](const glm::dvec4& plane) {
    return std::ranges::all_of(points, [&](const glm::dvec3& p) {
      return glm::dot(glm::dvec3(plane), p) + plane.w < -bulge;
    });
  });
}

// No point of a patch is nearer to the camera.
double nearest_m(const PatchPoints& points, double bulge) {
  glm::dvec3 toward(0);
  for (const glm::dvec3& p : points) toward += p;
  double nearest = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& p : points) nearest = std::min(nearest, glm::dot(toward, p));
  return nearest / glm::length(toward) - bulge;
}

float rounded_down(double x) {
  return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
}
float rounded_up(double x) { return -rounded_down(-x); }

Outline outline_of(std::size_t patch, const Corners& corners, const PatchPoints& points,
                   double bulge) {
  Outline outline;
  glm::dvec2 middle(0);
  for (const glm::dvec3& p : points) middle += 0.125 * glm::dvec2(p);
  double square = 0, low = 1e300, high = -1e300;
  for (const glm::dvec3& p : points) {
    const glm::dvec2 off = glm::dvec2(p) - middle;
    square = std::max(square, glm::dot(off, off));
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  const double half_width = std::sqrt(square) + bulge, distance = glm::length(middle);
  low -= bulge;
  high += bulge;
  outline.nearest = rounded_down(distance - half_width);
  outline.farthest = rounded_up(distance + half_width);
  if (outline.nearest <= bulge) {
    outline.nearest = 0;
    return outline;
  }
  outline.lowest = low / (low > 0 ? outline.farthest : outline.nearest);
  outline.highest = high / (high > 0 ? outline.nearest : outline.farthest);
  outline.reach = bulge / outline.nearest;
  // The patch spans less than half a turn.
  const double about = turn_of(middle);
  outline.from = outline.to = about;
  for (const std::size_t corner : corners.of(patch)) {
    const double turn = turn_near(about, corners.turn(corner));
    outline.from = std::min(outline.from, turn);
    outline.to = std::max(outline.to, turn);
  }
  return outline;
}

// The highest slope of the ground so far, over all azimuths.
class Horizon {
 public:
  explicit Horizon(int sectors) : slopes_(static_cast<std::size_t>(sectors), -1e300) {}

  // Raises the sectors that the patch fills from side to side.
  void raise(const Outline& patch) {
    const double first = std::ceil(sector(patch.from + patch.reach));
    const double end = std::floor(sector(patch.to - patch.reach));
    all_of(first, end - first, [&](double& slope) {
      slope = std::max(slope, patch.lowest);
      return true;
    });
  }

  bool hides(const Outline& patch) {
    const double first = std::floor(sector(patch.from - patch.reach));
    const double last = std::floor(sector(patch.to + patch.reach));
    return all_of(first, last + 1 - first, [&](double slope) { return slope >= patch.highest; });
  }

 private:
  double sector(double turn) const {
    return turn / kFullTurn * static_cast<double>(slopes_.size());
  }

  // Whether f is true of `count` sectors from `first` on, which may be turns away; stops where it
  // is not.
  template <class F>
  bool all_of(double first, double count, F&& f) {
    const auto n = static_cast<std::ptrdiff_t>(slopes_.size());
    std::ptrdiff_t i = static_cast<std::ptrdiff_t>(first) % n;
    if (i < 0) i += n;
    for (auto left = static_cast<std::ptrdiff_t>(count); left > 0; --left) {
      if (!f(slopes_[static_cast<std::size_t>(i)])) return false;
      if (++i == n) i = 0;
    }
    return true;
  }

  std::vector<double> slopes_;
};

// A patch just beyond its block's splitting distance spans an eighth of the ratio's inverse, some
// twelve sectors.
constexpr double kSectorsPerRatio = 600;

using Outlines = std::vector<Outline>;  // of all patches of all blocks, kPatches of each

// The numbers of the patches ahead of the camera in the order of one of their distances: the bits
// of a positive number grow with it.
std::vector<std::uint32_t> ordered(const Outlines& patches, float Outline::*distance) {
  std::vector<std::uint64_t> keys;
  keys.reserve(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    if (patches[i].nearest > 0)
      keys.push_back(std::uint64_t{std::bit_cast<std::uint32_t>(patches[i].*distance)} << 32 | i);
  }
  std::ranges::sort(keys);
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const std::uint64_t key : keys) order.push_back(static_cast<std::uint32_t>(key));
  return order;
}

// Drops the patches that nearer ones hide.
void drop_hidden(const Outlines& patches, double split_ratio, std::span<BlockPatches> chosen) {
  std::vector<std::uint32_t> by_start, by_end;
  tbb::parallel_invoke([&] { by_start = ordered(patches, &Outline::nearest); },
                       [&] { by_end = ordered(patches, &Outline::farthest); });
  Horizon horizon(static_cast<int>(kSectorsPerRatio * split_ratio));
  auto passed = by_end.begin();
  for (const std::uint32_t i : by_start) {
    for (; passed != by_end.end() && patches[*passed].farthest <= patches[i].nearest; ++passed)
      horizon.raise(patches[*passed]);
    if (horizon.hides(patches[i])) chosen[i / kPatches].seen.reset(i % kPatches);
  }
}

}  // namespace

std::vector<BlockPatches> choose_patches(const TerrainView& view,
                                         std::span<const MeasuredBlock> blocks) {
  const glm::dmat3 site_from_planet = view.axes.site_from_planet();
  const std::vector<glm::dvec4> bounds = view.bounds();
  const bool camera = view.planes.empty();
  std::vector<BlockPatches> chosen(blocks.size());
  Outlines outlines(blocks.size() * kPatches);  // of those that are seen
  tbb::parallel_for(std::size_t{0}, blocks.size(), [&](std::size_t i) {
    const auto& [block, heights, morphed_m] = blocks[i];
    const Corners corners(view, block, site_from_planet);
    const double bulge = bulge_m(block, view.radius_m);
    for (std::size_t patch = 0; patch < kPatches; ++patch) {
      const PatchPoints points = points_of(patch, corners, heights.patches[patch]);
      const double nearest = nearest_m(points, bulge);
      chosen[i].coarse[patch] = nearest >= morphed_m;
      if (view.cull && outside(bounds, points, bulge)) continue;
      chosen[i].seen.set(patch);
      chosen[i].nearest_m = std::min(chosen[i].nearest_m, nearest);
      if (camera) outlines[i * kPatches + patch] = outline_of(patch, corners, points, bulge);
    }
  });
  if (view.cull && view.most_lift == 0) drop_hidden(outlines, view.split_ratio, chosen);
  return chosen;
}

std::size_t shape_of(std::size_t patch, const PatchSet& coarse) {
  if (!coarse[patch]) return kWholePatch;
  const std::size_t column = patch % kPatchesPerSide, row = patch / kPatchesPerSide;
  unsigned whole_sides = 0;
  if (column > 0 && !coarse[patch - 1]) whole_sides |= kLeftSide;
  if (column + 1 < kPatchesPerSide && !coarse[patch + 1]) whole_sides |= kRightSide;
  if (row > 0 && !coarse[patch - kPatchesPerSide]) whole_sides |= kLowerSide;
  if (row + 1 < kPatchesPerSide && !coarse[patch + kPatchesPerSide]) whole_sides |= kUpperSide;
  return coarse_patch(whole_sides);
}

}  // namespace skyfit
