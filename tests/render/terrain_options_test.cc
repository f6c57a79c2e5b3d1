// SPDX-License-Identifier: Apache-2.0
// What is said of the blocks of the ground is what is drawn: culling changes no pixel, a larger
// constant divides more, a picture from above has the blocks of the camera below, boxes have their
// colours and leave no trace in the next frame.
#include <gmock/gmock.h>

#include <algorithm>

#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

FrameOptions valley(const TerrainOptions& terrain = {}) {
  FrameOptions options = options_of("valley", 64, 40);
  options.terrain = terrain;
  return options;
}

int leaves_and_culled(const FrameStatistics& s) {
  return s.blocks_drawn + s.blocks_hidden + s.blocks_outside + s.blocks_behind;
}

TEST(Culling, ChangesNoPixel) {
  const Frame with = renderer().draw(valley({.lod_constant = 60, .levels = 11}));
  const Frame without = renderer().draw(valley({.lod_constant = 60, .levels = 11, .cull = false}));
  EXPECT_EQ(without.statistics.blocks_outside, 0);
  EXPECT_EQ(without.statistics.blocks_behind, 0);
  EXPECT_EQ(without.statistics.blocks_hidden, 0);
  EXPECT_GT(without.statistics.triangles, 3 * with.statistics.triangles);
  EXPECT_EQ(without.depth_m, with.depth_m);
  EXPECT_EQ(without.luminance, with.luminance);
}

// The neighbourhood of a camera near the ground within which blocks of one level are divided is
// `constant` edges wide: up to four times the blocks for twice the constant.
TEST(LodConstant, DividesMoreBlocksTheLargerItIs) {
  const auto leaves = [](double constant) {
    return renderer()
        .draw(valley({.lod_constant = constant, .levels = 7, .cull = false}))
        .statistics.blocks_drawn;
  };
  const int coarse = leaves(60), fine = leaves(120);
  EXPECT_GT(fine, 1.5 * coarse);
  EXPECT_LT(fine, 4 * coarse);
}

TEST(Levels, OneIsTheSixFacesOfTheCube) {
  const FrameStatistics s = renderer().draw(valley({.levels = 1})).statistics;
  EXPECT_GT(s.blocks_drawn, 0);
  EXPECT_EQ(leaves_and_culled(s), 6);
}

TEST(TerrainOptions, OutOfTheirRangesAreRefused) {
  EXPECT_THROW(validate(valley({.lod_constant = 57.5})), std::invalid_argument);
  EXPECT_THROW(validate(valley({.lod_constant = 1601})), std::invalid_argument);
  EXPECT_THROW(validate(valley({.levels = 0})), std::invalid_argument);
  EXPECT_THROW(validate(valley({.levels = 31})), std::invalid_argument);
  FrameOptions overview = valley({.eye = Camera{}});
  EXPECT_NO_THROW(validate(overview));
  overview.shadows = true;
  EXPECT_THROW(validate(overview), std::invalid_argument);
}

// Pixels of the ground whose albedo is `channel` and hardly anything else.
int pixels_of_color(const Frame& frame, std::size_t channel) {
  int count = 0;
  for (std::size_t i = 0; i < frame.luminance.size(); ++i) {
    const float* const albedo = frame.layers->albedo.data() + 3 * i;
    const float others = std::max(albedo[(channel + 1) % 3], albedo[(channel + 2) % 3]);
    if (albedo[channel] > 0.4f && others < 0.25f * albedo[channel]) ++count;
  }
  return count;
}

FrameOptions from_above(const FrameOptions& seen, double overview_m, BlockColors boxes) {
  FrameOptions options = seen;
  options.terrain.eye = seen.camera;
  options.terrain.boxes = boxes;
  options.camera.altitude_m += overview_m;
  options.camera.view_zenith = std::numbers::pi;
  return options;
}

// From above stand the blocks that the camera below sees, and the boxes of those that it does not.
TEST(Overview, ShowsTheBlocksOfTheEye) {
  constexpr double kAbove = 3e5;
  const FrameStatistics eye = renderer().draw(valley()).statistics;
  const Frame above = draw_layers(from_above(valley(), kAbove, BlockColors::kCulling));
  EXPECT_EQ(above.statistics.triangles, eye.triangles);
  EXPECT_EQ(above.statistics.blocks_drawn, eye.blocks_drawn);
  EXPECT_EQ(above.statistics.blocks_outside, eye.blocks_outside);
  EXPECT_EQ(above.statistics.blocks_behind, eye.blocks_behind);
  EXPECT_GT(pixels_of_color(above, 0), 20) << "red: outside the picture below";
  EXPECT_GT(pixels_of_color(above, 1), 5) << "green: drawn";
  EXPECT_NEAR(above.view_zenith_deg[above.luminance.size() / 2 + 32], 180, 2);
}

TEST(Boxes, AndWireframeLeaveNoTraceInTheNextFrame) {
  const Frame before = renderer().draw(valley());
  const Frame lines =
      renderer().draw(valley({.lod_constant = 60, .levels = 11, .wireframe = true}));
  const Frame boxes = draw_layers(valley({.boxes = BlockColors::kCulling}));
  const Frame after = renderer().draw(valley());
  EXPECT_EQ(after.luminance, before.luminance);
  const auto ground = [](const Frame& frame) {
    return std::ranges::count_if(frame.depth_m, [](float depth) { return std::isfinite(depth); });
  };
  EXPECT_GT(ground(lines), 0);
  EXPECT_LT(ground(lines), ground(before)) << "the sky is between the edges";
  EXPECT_GT(pixels_of_color(boxes, 1), 5);
  EXPECT_EQ(pixels_of_color(boxes, 0), 0) << "what is outside cannot be seen";
}

}  // namespace
}  // namespace skyfit
