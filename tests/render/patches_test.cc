// SPDX-License-Identifier: Apache-2.0
// The patches that are left out change no pixel: of the blocks of a view the visible patches give
// the same depth and colour as all of them.
#include "render/gl/terrain/patches.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <set>

#include "render/gl/passes/gbuffer.h"
#include "render/gl/terrain/terrain_pass.h"
#include "render/gl/terrain/terrain_view.h"
#include "tests/render/gl_fixture.h"
#include "tests/render/terrain_fixture.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr int kWidth = 320, kHeight = 180;

struct Eye {
  const char* name;
  double latitude, longitude, above_ground_m, zenith, azimuth, fov;  // degrees
};

struct Shot {
  TerrainView view;
  Projection projection;
};

Shot shot_of(const Eye& eye) {
  TerrainView view;
  view.axes = site_axes(Site{eye.latitude * kDegree, eye.longitude * kDegree, 0});
  view.altitude_m = eye.above_ground_m + std::max(relief().height_m(view.axes.z, 0.3), 0.0);
  const Camera camera{view.altitude_m, eye.zenith * kDegree, eye.azimuth * kDegree,
                      eye.fov * kDegree};
  view.basis = view_basis(camera);
  const Projection projection = make_projection(camera, 1.0 * kWidth / kHeight);
  view.tangent = projection.tangent;
  view.radius_m = kEarth;
  view.highest_m = relief().highest_m();
  view.split_ratio = 2;
  view.levels = 15;
  return {view, projection};
}

struct Picture {
  std::vector<float> depth;
  std::vector<std::uint32_t> gbuffer;
  TerrainDraw draw;
};

class Patches : public ::testing::Test {
 protected:
  Picture picture(const Shot& shot, bool cull) {
    TerrainView view = shot.view;
    const BlockSelection selection = affordable_blocks(view, {}, store()).front();
    view.cull = cull;
    Picture made;
    terrain_.prepare(selection.blocks, view, made.draw);
    add_gbuffer(kWidth, kHeight, graph_);
    graph_.run(std::array{Pass{"terrain", {}, kGBuffer, [&] {
                                 clear_gbuffer();
                                 terrain_.draw(made.draw, shot.projection, view.axes);
                               }}});
    made.depth = graph_.read_rows("depth", GL_DEPTH_COMPONENT, 1, 0, kHeight);
    made.gbuffer = graph_.read_back_words("gbuffer");
    return made;
  }

 private:
  BlockStore& store() { return terrain_.store(); }

  std::unique_ptr<GlContext> context_ = make_osmesa_context();
  TerrainPass terrain_{relief(), kEarth, nullptr};
  FrameGraph graph_;
};

// Places in and near the valley; eyes in, over and far above the ground.
const std::vector<Eye>& eyes() {
  static const std::vector<Eye> made = [] {
    std::vector<Eye> list;
    for (const double azimuth : {0.0, 70.0, 140.0, 210.0, 280.0}) {
      for (const double above : {1.0, 20.0, 300.0, 3e3, 40e3})
        list.push_back({"about the valley", -71.6, -76.8, above, 90, azimuth, 50});
      list.push_back({"down a slope", -71.5, -76.7, 1500, 120, azimuth, 90});
      list.push_back({"a narrow view", -71.62, -76.82, 10, 91, azimuth, 5});
    }
    list.push_back({"from orbit", 12, 41, 400e3, 110, 0, 60});
    list.push_back({"the whole disc", 12, 41, 20e6, 180, 0, 40});
    list.push_back({"straight down", 12, 41, 500, 180, 0, 60});
    return list;
  }();
  return made;
}

// From the eye to what the pixels show.
double nearest_m(const std::vector<float>& depth, const Projection& projection) {
  double nearest = std::numeric_limits<double>::infinity();
  for (int row = 0; row < kHeight; ++row) {
    for (int column = 0; column < kWidth; ++column) {
      const float seen = depth[static_cast<std::size_t>(row) * kWidth + column];
      const double x = projection.tangent.x * ((2.0 * column + 1) / kWidth - 1);
      const double y = projection.tangent.y * ((2.0 * row + 1) / kHeight - 1);
      nearest = std::min(nearest, 1e3 * projection.near_km / seen * std::hypot(1.0, x, y));
    }
  }
  return nearest;
}

TEST_F(Patches, ThatAreLeftOutChangeNoPixel) {
  std::int64_t drawn = 0, whole = 0;
  int seen = 0;
  for (const Eye& eye : eyes()) {
    const Shot shot = shot_of(eye);
    const Picture some = picture(shot, true), all = picture(shot, false);
    EXPECT_LE(some.draw.triangles, all.draw.triangles);
    drawn += some.draw.triangles;
    whole += all.draw.triangles;
    int different = 0;
    for (std::size_t i = 0; i < all.depth.size(); ++i) {
      bool same = some.depth[i] == all.depth[i];
      for (std::size_t k = 0; k < 4 && all.depth[i] > 0; ++k) {
        same = same && some.gbuffer[4 * i + k] == all.gbuffer[4 * i + k];
      }
      different += same ? 0 : 1;
      seen += all.depth[i] > 0 ? 1 : 0;
    }
    EXPECT_LE(some.draw.nearest_m, nearest_m(all.depth, shot.projection) * (1 + 1e-6)) << eye.name;
    EXPECT_EQ(different, 0) << eye.name << ", " << eye.above_ground_m << " m, azimuth "
                            << eye.azimuth;
  }
  std::printf("[ drawn  ] %.1f %% of the triangles of the blocks, in %zu views\n",
              100.0 * static_cast<double>(drawn) / static_cast<double>(whole), eyes().size());
  EXPECT_GT(seen, 1000000);
  EXPECT_LT(drawn, whole / 2);
}

// A coarse patch has no vertex that still shows the finer shape.
TEST(Coarse, PatchesAreBeyondTheDistance) {
  TerrainView view = shot_of(eyes().front()).view;
  for (const double above : {1.0, 2e3, 50e3}) {
    view.altitude_m = above + relief().height_m(view.axes.z, 0.3);
    std::vector<MeasuredBlock> blocks;
    std::vector<MadeBlock> made;
    for (const int level : {6, 8, 10}) {
      const CubeBlock block = block_at(view.axes.z, level);
      const double arc = block_arc_m(level, kEarth);
      for (const double morphed : {0.3 * arc, 0.6 * arc}) {
        std::vector<BlockVertex> vertices(kBlockVertices);
        const BlockHeights heights = make_block(block, relief(), kEarth, vertices);
        blocks.push_back({block, heights, morphed});
        made.push_back({vertices, heights.whole, block_centre(block, kEarth)});
      }
    }
    const std::vector<BlockPatches> chosen = choose_patches(view, blocks);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      int beyond = 0;
      for (std::size_t patch = 0; patch < kPatches; ++patch) {
        double nearest = 1e300;
        for (int k = 0; k < 25; ++k) {
          const int column = 4 * static_cast<int>(patch % kPatchesPerSide) + k % 5;
          const int row = 4 * static_cast<int>(patch / kPatchesPerSide) + k / 5;
          nearest = std::min(nearest,
                             glm::distance(made[i].fine(made[i].at(column, row)), view.camera()));
        }
        beyond += nearest >= blocks[i].morphed_m ? 1 : 0;
        if (chosen[i].coarse[patch]) {
          EXPECT_GE(nearest, blocks[i].morphed_m - 1);
        }
      }
      const auto coarse = static_cast<int>(chosen[i].coarse.count());
      EXPECT_LE(coarse, beyond);
      EXPECT_GE(coarse, 0.8 * beyond) << "level " << blocks[i].block.level;
    }
  }
}

// Of more blocks than the memory holds, those of the view and of the shadows are made coarser
// together: all that are chosen are in it.
TEST(Affordable, BlocksOfAViewAndOfShadowsAreInTheStore) {
  class Plain final : public Ground {
   public:
    Elevation elevation(const glm::dvec3&, double) const override { return {0, 1}; }
    std::optional<NodeValues> water_reflectance() const override { return std::nullopt; }
    NodeValues reflectance(const glm::dvec3&, double, double, double) const override { return {}; }
    double rock(const glm::dvec3&, double, double, double) const override { return 0; }
    double highest_m() const override { return 0; }
    void add_inputs(CacheKey&) const override {}
  };
  const std::unique_ptr<GlContext> context = make_osmesa_context();
  const Plain plain;
  BlockStore store(plain, kEarth, nullptr);
  TerrainView view = shot_of({"a narrow view", 46, 7, 3000, 95, 0, 20}).view;
  view.highest_m = 0;
  view.split_ratio = 13;
  // A square of 60 km about the camera, as of a shadow map.
  const Planes square = {{1, 0, 0, 30e3}, {-1, 0, 0, 30e3}, {0, 1, 0, 30e3}, {0, -1, 0, 30e3}};
  std::size_t count = 0;
  for (const BlockSelection& selection : affordable_blocks(view, std::array{square}, store)) {
    for (const CubeBlock& block : selection.blocks) EXPECT_NO_THROW(store.first_vertex(block));
    count += selection.blocks.size();
  }
  EXPECT_LT(view.split_ratio, 13) << "the memory is too large for this test";
  EXPECT_GT(count, 100);
}

// Ground behind a ridge is hidden from its foot and seen from above it.
TEST(Horizon, HidesWhatLiesBehindARidge) {
  TerrainView view;
  view.axes = site_axes({});
  view.altitude_m = 2;
  view.basis = view_basis({2, 0.5 * std::numbers::pi, 0, 1});
  view.tangent = {2, 2};
  view.radius_m = kEarth;
  constexpr int kLevel = 12;
  const double arc = block_arc_m(kLevel, kEarth) / kEarth;
  // The blocks about a place as many arcs ahead and to the left; all of one height.
  const auto blocks_at = [&](double ahead, double half_width, double height) {
    std::set<CubeBlock> found;
    for (double left = -half_width; left <= half_width; left += 0.5) {
      for (const double further : {-0.5, 0.0, 0.5}) {
        found.insert(
            block_at(glm::normalize(view.axes.z + std::tan((ahead + further) * arc) * view.axes.x +
                                    std::tan(left * arc) * view.axes.y),
                     kLevel));
      }
    }
    std::vector<MeasuredBlock> measured;
    for (const CubeBlock& block : found) {
      measured.push_back({block, {{height, height}, {}}, 1e30});
      measured.back().heights.patches.fill({height, height});
    }
    return measured;
  };
  const std::vector<MeasuredBlock> ridge = blocks_at(4, 8, 500);
  const auto share_seen = [&](const std::vector<MeasuredBlock>& behind) {
    std::vector<MeasuredBlock> blocks = behind;
    blocks.insert(blocks.end(), ridge.begin(), ridge.end());
    const std::vector<BlockPatches> chosen = choose_patches(view, blocks);
    std::size_t patches = 0;
    for (std::size_t i = 0; i < behind.size(); ++i) patches += chosen[i].seen.count();
    return static_cast<double>(patches) / static_cast<double>(behind.size() * kPatches);
  };
  const std::vector<MeasuredBlock> plain = blocks_at(9, 3, 0), summit = blocks_at(9, 3, 3000);
  // Where the borders between patches of the ridge run toward the camera, none fills a whole
  // sector.
  EXPECT_LT(share_seen(plain), 0.05);
  EXPECT_GT(share_seen(summit), 0.1);  // the side toward the camera: level ground hides itself
  view.altitude_m = 1500;
  EXPECT_EQ(share_seen(plain), 1);
  view.altitude_m = 2;
  view.planes = view.bounds();  // no camera's
  EXPECT_EQ(share_seen(plain), 1);
}

}  // namespace
}  // namespace skyfit
