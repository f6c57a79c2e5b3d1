// SPDX-License-Identifier: Apache-2.0
// Blocks that a view chooses cover the sphere once, differ from their neighbours by one level at
// most, and culling leaves out no block of which a vertex can be seen.
#include "render/gl/terrain/planet_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

#include "render/render.h"
#include "tests/render/terrain_fixture.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
// m: positions of 1e7 m in double, of 1e5 m in float from a centre.
constexpr double kRounding = 1e-3;
constexpr double kGrazing = 1e-6;  // m: the sea, in double

TerrainView view_at(double altitude_m, double zenith_deg, double azimuth_deg, double ratio,
                    int levels) {
  TerrainView view;
  view.axes = relief().coast();
  view.altitude_m = altitude_m;
  view.basis = view_basis({altitude_m, zenith_deg * kDegree, azimuth_deg * kDegree, 1});
  view.tangent = {std::tan(0.5) * 1.6, std::tan(0.5)};
  view.radius_m = kEarth;
  view.highest_m = relief().highest_m();
  view.split_ratio = ratio;
  view.levels = levels;
  return view;
}

const std::vector<TerrainView>& views() {
  static const std::vector<TerrainView> made = [] {
    std::vector<TerrainView> list;
    for (const double altitude : {1.0, 100.0, 10e3, 400e3, kEarth, 10 * kEarth}) {
      for (const double zenith : {80.0, 110.0, 180.0})
        list.push_back(view_at(altitude, zenith, 37 * altitude, 1.6, 12));
    }
    list.push_back(view_at(400e3, 106, -100, 4, 9));
    return list;
  }();
  return made;
}

TEST(BlockBox, HoldsTheVerticesOfTheBlock) {
  const glm::dmat3 axes = relief().coast().site_from_planet();
  for (int level = 0; level <= 14; level += 2) {
    for (int i = 0; i < 12; ++i) {
      const double z = 1 - (2 * i + 1.0) / 12, turn = 2.399963 * i, s = std::sqrt(1 - z * z);
      const CubeBlock block = block_at({s * std::cos(turn), s * std::sin(turn), z}, level);
      const MadeBlock made = made_block(block);
      const Box box = block_box(block, made.heights, axes, kEarth);
      for (const BlockVertex& vertex : made.vertices) {
        for (const glm::dvec3& p : {made.fine(vertex), made.coarse(vertex)}) {
          const glm::dvec3 q = axes * p;
          const glm::dvec3 out = glm::max(box.low - q, q - box.high);
          ASSERT_LT(std::max({out.x, out.y, out.z}), kRounding)
              << "face " << block.face << ", level " << level;
        }
      }
    }
  }
}

// In units of the smallest blocks' sides of a face.
struct Square {
  std::int64_t u, v, side;
};
Square square_of(const CubeBlock& block, int finest) {
  const std::int64_t side = std::int64_t{1} << (finest - block.level);
  return {block.column * side, block.row * side, side};
}

TEST(Selection, CoversTheSphereOnce) {
  for (TerrainView view : views()) {
    view.cull = false;
    const BlockSelection selection = select_blocks(view, stored_heights);
    EXPECT_TRUE(selection.outside.empty() && selection.behind.empty());
    const int finest = view.levels;
    // Areas add up to six faces and no block lies inside another one.
    const std::set<CubeBlock> chosen(selection.blocks.begin(), selection.blocks.end());
    ASSERT_EQ(chosen.size(), selection.blocks.size());
    double area = 0;
    for (const CubeBlock& block : selection.blocks) {
      const Square square = square_of(block, finest);
      area += std::ldexp(static_cast<double>(square.side * square.side), -2 * finest);
      for (CubeBlock parent = block; parent.level > 0;) {
        parent = {parent.face, parent.level - 1, parent.column / 2, parent.row / 2};
        ASSERT_FALSE(chosen.contains(parent));
      }
    }
    EXPECT_EQ(area, 6);
  }
}

TEST(Selection, HasNeighboursOfEqualOrAdjacentLevels) {
  for (TerrainView view : views()) {
    view.cull = false;
    const BlockSelection selection = select_blocks(view, stored_heights);
    const std::set<CubeBlock> chosen(selection.blocks.begin(), selection.blocks.end());
    for (const CubeBlock& block : selection.blocks) {
      constexpr double kAcross = 1e-3;  // a little beyond the border, in sides of the block
      for (const auto& [u, v] :
           {std::pair(-kAcross, 0.3), {1 + kAcross, 0.7}, {0.7, -kAcross}, {0.3, 1 + kAcross}}) {
        const glm::dvec3 beyond = block_direction(block, u, v);
        // The neighbour is an ancestor of the block of the finest level there, or it itself.
        CubeBlock neighbour = block_at(beyond, view.levels - 1);
        while (!chosen.contains(neighbour)) {
          ASSERT_GT(neighbour.level, 0);
          neighbour = {neighbour.face, neighbour.level - 1, neighbour.column / 2,
                       neighbour.row / 2};
        }
        EXPECT_LE(std::abs(neighbour.level - block.level), 1)
            << "altitude " << view.altitude_m << ", levels " << block.level << " and "
            << neighbour.level;
      }
    }
  }
}

TEST(Selection, IsSortedFromNearToFar) {
  for (const TerrainView& view : views()) {
    double before = 0;
    for (const CubeBlock& block : select_blocks(view, stored_heights).blocks) {
      // With the heights that a finer level could reach.
      const double margin = block_arc_m(block.level, kEarth) / kBlockQuads;
      const HeightRange own = stored_block(block).heights;
      const Box box = block_box(block, {own.low - margin, own.high + margin},
                                view.axes.site_from_planet(), kEarth);
      const glm::dvec3 camera(0, 0, kEarth + view.altitude_m);
      const double distance =
          glm::length(glm::max(glm::max(box.low - camera, camera - box.high), glm::dvec3(0)));
      EXPECT_GE(distance, before - kRounding);
      before = distance;
    }
  }
}

// Whether the camera sees a point as far as the frustum and the ground's sphere allow it.
bool visible(const TerrainView& view, const glm::dvec3& planet) {
  const glm::dvec3 camera(0, 0, kEarth + view.altitude_m);
  const glm::dvec3 ray = view.axes.site_from_planet() * planet - camera;
  const double along = glm::dot(ray, view.basis.forward);
  if (along <= 0 || std::abs(glm::dot(ray, view.basis.right)) > along * view.tangent.x ||
      std::abs(glm::dot(ray, view.basis.up)) > along * view.tangent.y)
    return false;
  // Of the way to the point, where it is nearest to the centre. What hangs below the sphere, a
  // skirt, is behind it.
  const double nearest = std::clamp(-glm::dot(camera, ray) / glm::dot(ray, ray), 0.0, 1.0);
  return glm::length(camera + nearest * ray) >= kEarth - kGrazing;
}

TEST(Culling, LeavesOutNoBlockWithAVisibleVertex) {
  int dropped = 0, kept = 0;
  for (TerrainView view : views()) {
    const BlockSelection culled = select_blocks(view, stored_heights);
    view.cull = false;
    const BlockSelection all = select_blocks(view, stored_heights);
    const std::set<CubeBlock> drawn(culled.blocks.begin(), culled.blocks.end());
    kept += static_cast<int>(culled.blocks.size());
    for (const CubeBlock& block : all.blocks) {
      if (drawn.contains(block)) continue;
      ++dropped;
      const MadeBlock& made = stored_block(block);
      for (const BlockVertex& vertex : made.vertices) {
        ASSERT_FALSE(visible(view, made.fine(vertex)) || visible(view, made.coarse(vertex)))
            << "altitude " << view.altitude_m << ", face " << block.face << ", level "
            << block.level;
      }
    }
    for (const CubeBlock& block : culled.blocks) {
      ASSERT_TRUE(std::find(all.blocks.begin(), all.blocks.end(), block) != all.blocks.end());
    }
  }
  std::printf("[ culled ] %d of %d blocks in %zu views\n", dropped, dropped + kept, views().size());
  EXPECT_GT(dropped, kept);
}

TEST(Culling, DrawsAtMostAThirdOfTheTrianglesOfTheValley) {
  const NamedView& valley = find_view("valley");
  TerrainView view = view_at(0, 0, 0, 1.6, 9);
  view.axes = site_axes(*valley.site);
  view.altitude_m = valley.camera.altitude_m + relief().height_m(view.axes.z, 0.3);
  view.basis = view_basis(valley.camera);
  const double tall = std::tan(0.5 * valley.camera.vertical_fov);
  view.tangent = {tall * 16 / 9, tall};
  view.levels = 15;
  const BlockSelection culled = select_blocks(view, stored_heights);
  view.cull = false;
  const auto all = static_cast<double>(select_blocks(view, stored_heights).blocks.size());
  const auto drawn = static_cast<double>(culled.blocks.size());
  const double triangles = static_cast<double>(block_indices().patches[kWholePatch].back()) / 3;
  std::printf(
      "[ culled ] %.0f of %.0f blocks drawn, %.0f and %.0f triangles (%.1f %%); %zu nodes "
      "outside, %zu behind\n",
      drawn, all, drawn * triangles, all * triangles, 100 * drawn / all, culled.outside.size(),
      culled.behind.size());
  EXPECT_LE(drawn, all / 3);
}

}  // namespace
}  // namespace skyfit
