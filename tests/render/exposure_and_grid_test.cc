// SPDX-License-Identifier: Apache-2.0
// The frames of a grid keep their pixels; the exposure of a sequence follows the light without
// jumps and does not depend on where it was interrupted.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "render/sequence/exposure.h"
#include "render/sequence/grid.h"

namespace skyfit {
namespace {

Frame grey(int width, int height, float luminance) {
  Frame frame;
  frame.width = width;
  frame.height = height;
  const std::size_t pixels = static_cast<std::size_t>(width) * height;
  frame.rgb.assign(3 * pixels, luminance);
  frame.luminance.assign(pixels, luminance);
  frame.view_zenith_deg.assign(pixels, 45);
  frame.view_azimuth_deg.assign(pixels, luminance);
  frame.depth_m.assign(pixels, 10);
  return frame;
}

// A pixel of the joined picture is that of its frame, or black between the frames.
TEST(JoinedGrid, PixelsStandWhereTheyBelong) {
  FrameGrid grid;
  grid.columns = 2;
  for (int i = 0; i < 4; ++i) grid.frames.push_back(grey(3, 2, 100.0f + static_cast<float>(i)));
  grid.frames[0].metadata = {{"skyfit:preset", "first"}};
  grid.metadata = {{"skyfit:rows", "altitude-m [m]: 1, 2"}};
  const Frame whole = joined(grid);
  ASSERT_EQ(whole.width, 3 + kGridGap + 3);
  ASSERT_EQ(whole.height, 2 + kGridGap + 2);
  const auto part_of = [](int x, int length) {
    return x < length ? 0 : x < length + kGridGap ? -1 : 1;
  };
  for (int y = 0; y < whole.height; ++y) {
    for (int x = 0; x < whole.width; ++x) {
      const auto at = static_cast<std::size_t>(y * whole.width + x);
      const int column = part_of(x, 3), row = part_of(y, 2);
      const bool between = column < 0 || row < 0;
      const float expected = between ? 0 : 100.0f + static_cast<float>(2 * row + column);
      EXPECT_EQ(whole.luminance[at], expected) << x << ", " << y;
      EXPECT_EQ(whole.view_azimuth_deg[at], expected);
      EXPECT_EQ(std::isinf(whole.depth_m[at]), between);
      for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(whole.rgb[3 * at + k], expected);
    }
  }
  ASSERT_EQ(whole.metadata.size(), 2u);
  EXPECT_EQ(whole.metadata[1].first, "skyfit:rows");
}

TEST(Exposure, IsThatOfWhatAPictureShows) {
  Frame disc = grey(8, 8, 3000);
  const double whole = metered_exposure(disc);
  for (std::size_t i = 0; i < 40; ++i) {
    disc.view_zenith_deg[i] = std::numeric_limits<float>::quiet_NaN();
    disc.luminance[i] = 0;
  }
  EXPECT_NEAR(metered_exposure(disc) / whole, 1, 1e-12);
}

TEST(JoinedGrid, DiscsEdgesAndGlareMoveWithTheirPixels) {
  FrameGrid grid;
  grid.frames = {grey(3, 2, 100), grey(3, 2, 200)};  // one below the other
  grid.frames[0].discs = {{4, 0.5f, {1, 1, 1}, 1}};
  grid.frames[1].discs = {{1, 0.5f, {2, 2, 2}, 2}, {5, 1, {3, 3, 3}, 3}};
  grid.frames[0].edges = {{2, 0.5f, {1, 1, 1}, {0, 0, 0}}};
  grid.frames[1].edges = {{3, 0.5f, {1, 1, 1}, {0, 0, 0}}};
  grid.frames[1].glare.assign(18, 7);
  const Frame whole = joined(grid);
  constexpr std::size_t kBelow = 3 * (2 + kGridGap);
  ASSERT_EQ(whole.discs.size(), 3u);
  EXPECT_EQ(whole.discs[0].pixel, 4u);
  EXPECT_EQ(whole.discs[1].pixel, kBelow + 1);
  EXPECT_EQ(whole.discs[2].pixel, kBelow + 5);
  ASSERT_EQ(whole.edges.size(), 2u);
  EXPECT_EQ(whole.edges[0].pixel, 2u);
  EXPECT_EQ(whole.edges[1].pixel, kBelow + 3);
  ASSERT_EQ(whole.glare.size(), whole.rgb.size());
  EXPECT_EQ(whole.glare[3 * kBelow - 1], 0);
  EXPECT_EQ(whole.glare[3 * kBelow], 7);
}

TEST(JoinedGrid, FramesMustGoTogether) {
  FrameGrid grid;
  grid.frames = {grey(3, 2, 100), grey(3, 3, 100)};
  EXPECT_THROW(joined(grid), std::invalid_argument);
  grid.columns = 2;
  grid.frames.assign(3, grey(3, 2, 1));
  EXPECT_THROW(joined(grid), std::invalid_argument);
}

TEST(GridAxis, EvenStepsHaveOneDifferenceGeometricOnesOneFactor) {
  EXPECT_THAT(spaced(2, 8, 4, Spacing::kEven), ::testing::ElementsAre(2, 4, 6, 8));
  EXPECT_THAT(spaced(1e-6, 1e-3, 4, Spacing::kGeometric),
              ::testing::ElementsAre(1e-6, 1e-5, 1e-4, 1e-3));
  EXPECT_THAT(spaced(-1, -4, 3, Spacing::kGeometric), ::testing::ElementsAre(-1, -2, -4));
  EXPECT_THROW(spaced(0, 1, 3, Spacing::kGeometric), std::invalid_argument);
  EXPECT_THROW(spaced(-1, 1, 3, Spacing::kGeometric), std::invalid_argument);
}

TEST(GridAxis, IsDescribedWithUnits) {
  const GridAxis columns = {{"ground.albedo", "ground.albedo", "1", {"0.1", "0.123456789"}},
                            {"altitude-m", "altitude", "m", {"2", "20000"}}};
  const GridAxis rows = {{"model", "model", "", {"bodare", "reference"}}};
  EXPECT_EQ(described(columns), "ground.albedo [1]: 0.1, 0.123456789; altitude-m [m]: 2, 20000");
  EXPECT_EQ(described(rows), "model: bodare, reference");
  EXPECT_EQ(steps_of({}), 1u);
  const std::vector<Caption> captions = captions_at(columns, 1, rows, 0);
  ASSERT_EQ(captions.size(), 3u);
  EXPECT_EQ(captions[0].value, "0.1235");
  EXPECT_EQ(captions[1].name + " " + captions[1].value, "altitude 20000 m");
  EXPECT_EQ(captions[2].value, "bodare");
}

TEST(MeteredExposure, MakesAnEvenPictureMiddleGreyAndABrighterOneBrighter) {
  EXPECT_NEAR(metered_exposure(grey(4, 4, 500)) * 500, 0.18, 1e-6);
  EXPECT_NEAR(metered_exposure(grey(4, 4, 8000)) * 8000, 0.18 * std::pow(16, 0.15), 1e-6);
}

// Frames that are shown alike: as one picture that holds the pixels of all.
TEST(MeteredExposure, OfSeveralFramesIsThatOfTheirPixelsTogether) {
  const Frame dark = grey(4, 4, 500), bright = grey(4, 4, 8000);
  Frame both = grey(4, 8, 500);
  std::fill(both.luminance.begin() + 16, both.luminance.end(), 8000.0f);
  const Frame* const frames[] = {&dark, &bright};
  EXPECT_NEAR(metered_exposure(frames) / metered_exposure(both), 1, 1e-12);
  const Frame* const twice[] = {&dark, &dark};
  EXPECT_NEAR(metered_exposure(twice) / metered_exposure(dark), 1, 1e-12);
}

// A planet in space is exposed for what is white in the sun, which is not in the picture.
TEST(MeteredExposure, DoesNotMakeAPlanetGrey) {
  Frame frame = grey(10, 10, 5000);
  for (std::size_t i = 0; i < 50; ++i) frame.luminance[i] = 0;
  EXPECT_NEAR(metered_exposure(frame), 1 / 2e4, 1e-9);
  for (std::size_t i = 95; i < 100; ++i) frame.luminance[i] = 16e3;  // clouds
  EXPECT_NEAR(metered_exposure(frame), 1 / 3e4, 1e-9);
}

// One pixel in fifty, far brighter than the rest, is shown three times as bright as white.
TEST(MeteredExposure, HighlightsMayBeThreeTimesWhite) {
  Frame frame = grey(100, 100, 500);
  for (std::size_t i = 0; i < 200; ++i) frame.luminance[i] = 2e4f;
  EXPECT_NEAR(metered_exposure(frame) * 2e4, 3, 1e-6);
  for (std::size_t i = 50; i < 200; ++i) frame.luminance[i] = 500;  // half of a hundredth
  EXPECT_LT(metered_exposure(frame), 0.18 / 500 * 1.01);
  EXPECT_GT(metered_exposure(frame), 0.17 / 500);
}

// A small disc does not count, for a large one the picture is exposed.
TEST(MeteredExposure, FollowsTheSunInATelephotoPictureOnly) {
  Frame frame = grey(100, 100, 5000);
  const double without = metered_exposure(frame);
  const auto add = [&](std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      frame.luminance[i] += 1e9f;
      frame.discs.push_back({i, 1, {1e9f, 1e9f, 1e9f}, 1e9f});
    }
  };
  add(20);
  EXPECT_NEAR(metered_exposure(frame) / without, 1, 1e-4);
  frame = grey(100, 100, 5000);
  add(900);
  EXPECT_NEAR(metered_exposure(frame) * 1e9, 0.8, 1e-3);
  const Frame* const twice[] = {&frame, &frame};
  EXPECT_NEAR(metered_exposure(twice) * 1e9, 0.8, 1e-3) << "as large in each of two pictures";
}

TEST(Adaptation, FollowsAJumpByItsTime) {
  Adaptation adaptation(2);
  EXPECT_EQ(adaptation.next(1, 0), 1);
  double exposure = 0;
  for (int i = 0; i < 20; ++i) exposure = adaptation.next(std::numbers::e, 0.1);
  EXPECT_NEAR(std::log(exposure), 1 - std::exp(-1), 1e-9);
}

TEST(Adaptation, AtOnceWithoutTime) {
  Adaptation adaptation(0);
  adaptation.next(1, 0);
  EXPECT_DOUBLE_EQ(adaptation.next(5, 0.04), 5);
}

TEST(Adaptation, AtOnceWhereMinutesPassBetweenFrames) {
  Adaptation adaptation(1);
  adaptation.next(1, 0);
  EXPECT_DOUBLE_EQ(adaptation.next(1e4, 255), 1e4);
}

TEST(Adaptation, DependsOnTheMeteredExposuresOnly) {
  Adaptation first(1), second(1);
  for (const double metered : {1.0, 3.0, 2.0, 8.0})
    EXPECT_EQ(first.next(metered, 0.04), second.next(metered, 0.04));
}

}  // namespace
}  // namespace skyfit
