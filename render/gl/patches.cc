// SPDX-License-Identifier: Apache-2.0
#include "render/gl/patches.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>
#include <utility>

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
  std::size_t block = 0, patch = 0;
  double nearest = 0, farthest = 0;  // horizontally; nearest <= 0: may be around the camera
  double from = 0, to = 0;           // turns of its corners
  double reach = 0;                  // by how much its sides may bulge out of them or in
  double lowest = 0, highest = 0;    // slopes: height above the camera's by horizontal distance
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
  glm::dvec3 middle(0);
  for (const glm::dvec3& p : points) middle += p;
  const glm::dvec3 toward = glm::normalize(middle);
  double nearest = 1e300;
  for (const glm::dvec3& p : points) nearest = std::min(nearest, glm::dot(toward, p));
  return nearest - bulge;
}

Outline outline_of(std::size_t block, std::size_t patch, const Corners& corners,
                   const PatchPoints& points, double bulge) {
  Outline outline;
  outline.block = block;
  outline.patch = patch;
  glm::dvec2 middle(0);
  for (const glm::dvec3& p : points) middle += 0.125 * glm::dvec2(p);
  double half_width = 0, low = 1e300, high = -1e300;
  for (const glm::dvec3& p : points) {
    half_width = std::max(half_width, glm::distance(middle, glm::dvec2(p)));
    low = std::min(low, p.z);
    high = std::max(high, p.z);
  }
  half_width += bulge;
  low -= bulge;
  high += bulge;
  outline.nearest = glm::length(middle) - half_width;
  outline.farthest = glm::length(middle) + half_width;
  if (outline.nearest <= 0) return outline;
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
    const auto first = static_cast<std::ptrdiff_t>(std::ceil(sector(patch.from + patch.reach)));
    const auto end = static_cast<std::ptrdiff_t>(std::floor(sector(patch.to - patch.reach)));
    for (std::ptrdiff_t i = first; i < end; ++i) at(i) = std::max(at(i), patch.lowest);
  }

  bool hides(const Outline& patch) {
    const auto first = static_cast<std::ptrdiff_t>(std::floor(sector(patch.from - patch.reach)));
    const auto last = static_cast<std::ptrdiff_t>(std::floor(sector(patch.to + patch.reach)));
    for (std::ptrdiff_t i = first; i <= last; ++i) {
      if (at(i) < patch.highest) return false;
    }
    return true;
  }

 private:
  double sector(double turn) const {
    return turn / kFullTurn * static_cast<double>(slopes_.size());
  }
  double& at(std::ptrdiff_t i) {
    const auto n = static_cast<std::ptrdiff_t>(slopes_.size());
    return slopes_[static_cast<std::size_t>((i % n + n) % n)];
  }

  std::vector<double> slopes_;
};

// A patch just beyond its block's splitting distance spans an eighth of the ratio's inverse, some
// twelve sectors.
constexpr double kSectorsPerRatio = 600;

using Outlines = std::vector<std::vector<Outline>>;  // of each block's patches

// The patches in the order of one of their distances.
std::vector<const Outline*> ordered(const Outlines& blocks, double Outline::*distance) {
  std::vector<std::pair<double, const Outline*>> order;
  for (const std::vector<Outline>& patches : blocks)
    for (const Outline& patch : patches) order.emplace_back(patch.*distance, &patch);
  std::ranges::sort(order);
  std::vector<const Outline*> patches;
  for (const auto& [key, patch] : order) patches.push_back(patch);
  return patches;
}

// Drops the patches that nearer ones hide.
void drop_hidden(const Outlines& blocks, double split_ratio, std::span<BlockPatches> chosen) {
  std::vector<const Outline*> by_start, by_end;
  tbb::parallel_invoke([&] { by_start = ordered(blocks, &Outline::nearest); },
                       [&] { by_end = ordered(blocks, &Outline::farthest); });
  Horizon horizon(static_cast<int>(kSectorsPerRatio * split_ratio));
  auto passed = by_end.begin();
  for (const Outline* patch : by_start) {
    for (; passed != by_end.end() && (*passed)->farthest <= patch->nearest; ++passed)
      horizon.raise(**passed);
    if (horizon.hides(*patch)) chosen[patch->block].seen.reset(patch->patch);
  }
}

}  // namespace

std::vector<BlockPatches> choose_patches(const TerrainView& view,
                                         std::span<const MeasuredBlock> blocks) {
  const glm::dmat3 site_from_planet = view.axes.site_from_planet();
  const std::vector<glm::dvec4> bounds = view.bounds();
  const bool camera = view.planes.empty();
  std::vector<BlockPatches> chosen(blocks.size());
  Outlines outlines(blocks.size());  // but for patches around the camera
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
      if (!camera) continue;
      const Outline outline = outline_of(i, patch, corners, points, bulge);
      if (outline.nearest > 0) outlines[i].push_back(outline);
    }
  });
  if (view.cull) drop_hidden(outlines, view.split_ratio, chosen);
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
