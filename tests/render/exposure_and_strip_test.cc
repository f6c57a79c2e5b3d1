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

TEST(SideBySide, HeightsMustAgree) {
  const std::vector<Frame> frames = {grey(3, 2, 100), grey(3, 3, 100)};
  EXPECT_THROW(side_by_side(frames, 1), std::invalid_argument);
}

TEST(MeteredExposure, MakesAnEvenPictureMiddleGrey) {
  EXPECT_NEAR(metered_exposure(grey(4, 4, 1000)) * 1000, 0.18, 1e-6);
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
