// SPDX-License-Identifier: Apache-2.0
// Frames side by side keep their pixels; the exposure of a sequence follows the light without
// jumps and does not depend on where it was interrupted.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "render/sequence/exposure.h"
#include "render/sequence/strip.h"

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

TEST(SideBySide, PixelsStandWhereTheyBelong) {
  const std::vector<Frame> frames = {grey(3, 2, 100), grey(2, 2, 200)};
  const Frame whole = side_by_side(frames, 1);
  ASSERT_EQ(whole.width, 6);
  ASSERT_EQ(whole.height, 2);
  const std::vector<float> row = {100, 100, 100, 0, 200, 200};
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(whole.luminance[i], row[i % 6]);
    EXPECT_EQ(whole.view_azimuth_deg[i], row[i % 6]);
    for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(whole.rgb[3 * i + k], row[i % 6]);
  }
  EXPECT_TRUE(std::isinf(whole.depth_m[3]));
  EXPECT_EQ(whole.depth_m[4], 10);
}

TEST(SideBySide, DiscsAndGlareMoveWithTheirPixels) {
  std::vector<Frame> frames = {grey(3, 2, 100), grey(2, 2, 200)};
  frames[0].discs = {{4, 0.5f, {1, 1, 1}, 1}};
  frames[1].discs = {{1, 0.5f, {2, 2, 2}, 2}, {2, 1, {3, 3, 3}, 3}};
  frames[1].glare.assign(12, 7);
  const Frame whole = side_by_side(frames, 1);
  ASSERT_EQ(whole.discs.size(), 3u);
  EXPECT_EQ(whole.discs[0].pixel, 5u);
  EXPECT_EQ(whole.discs[1].pixel, 7u);
  EXPECT_EQ(whole.discs[2].pixel, 10u);
  ASSERT_EQ(whole.glare.size(), whole.rgb.size());
  EXPECT_EQ(whole.glare[0], 0);
  EXPECT_EQ(whole.glare[3 * 4], 7);
}

TEST(SideBySide, HeightsMustAgree) {
  const std::vector<Frame> frames = {grey(3, 2, 100), grey(3, 3, 100)};
  EXPECT_THROW(side_by_side(frames, 1), std::invalid_argument);
}

TEST(MeteredExposure, MakesAnEvenPictureMiddleGreyAndABrighterOneBrighter) {
  EXPECT_NEAR(metered_exposure(grey(4, 4, 500)) * 500, 0.18, 1e-6);
  EXPECT_NEAR(metered_exposure(grey(4, 4, 8000)) * 8000, 0.18 * std::pow(16, 0.15), 1e-6);
}

// A planet in space is exposed for what is white in the sun, which is not in the picture.
TEST(MeteredExposure, DoesNotMakeAPlanetGrey) {
  Frame frame = grey(10, 10, 5000);
  for (std::size_t i = 0; i < 50; ++i) frame.luminance[i] = 0;
  EXPECT_NEAR(metered_exposure(frame), 1 / 2e4, 1e-9);
  for (std::size_t i = 95; i < 100; ++i) frame.luminance[i] = 16e3;  // clouds
  EXPECT_NEAR(metered_exposure(frame), 1 / 3e4, 1e-9);
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
