// SPDX-License-Identifier: Apache-2.0
// A straight horizon that one sample to a pixel shows as steps has the coverage of its samples
// again.
#include "render/image/silhouette.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace skyfit {
namespace {

constexpr int kWidth = 160, kHeight = 90;

// Ground below y = height + slope * x, as its share of a pixel by points on a grid.
double ground_share(double height, double slope, int x, int y) {
  constexpr int kSide = 16;
  int below = 0;
  for (int i = 0; i < kSide * kSide; ++i) {
    const double px = x + (i % kSide + 0.5) / kSide, py = y + (i / kSide + 0.5) / kSide;
    below += py > height + slope * px ? 1 : 0;
  }
  return below / static_cast<double>(kSide * kSide);
}

double rms(double height, double slope, bool smooth) {
  std::vector<std::uint8_t> is_sky;
  std::vector<double> ground;
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      is_sky.push_back(y + 0.5 <= height + slope * (x + 0.5) ? 1 : 0);
      ground.push_back(1 - is_sky.back());
    }
  }
  const std::vector<double> steps = ground;
  if (smooth) {
    for (const SilhouetteSample& at : silhouette(is_sky, kWidth, kHeight))
      ground[at.sample] = std::lerp(ground[at.sample], steps[at.beside], at.share);
  }
  double sum = 0;
  int count = 0;
  for (int x = 4; x < kWidth - 4; ++x) {
    for (int y = 0; y < kHeight; ++y) {
      const double share = ground_share(height, slope, x, y);
      if (share <= 0 || share >= 1) continue;
      const double error = ground[static_cast<std::size_t>(y * kWidth + x)] - share;
      sum += error * error;
      ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

TEST(Silhouette, OfASlantedHorizonIsSmooth) {
  for (const double slope : {0.02, 0.07, 0.2, -0.13, 0.45, 3.0}) {
    const double height = slope < 2 ? 40.3 : -200.2;
    const double steps = rms(height, slope, false), smooth = rms(height, slope, true);
    std::printf("[ steps  ] slope %g: rms of the coverage %.3f, smooth %.3f\n", slope, steps,
                smooth);
    EXPECT_GT(steps, 0.2);
    EXPECT_LT(smooth, 0.5 * steps);
  }
}

TEST(Silhouette, OfALevelHorizonStays) {
  std::vector<std::uint8_t> is_sky(static_cast<std::size_t>(kWidth) * kHeight, 0);
  for (int i = 0; i < 45 * kWidth; ++i) is_sky[static_cast<std::size_t>(i)] = 1;
  EXPECT_TRUE(silhouette(is_sky, kWidth, kHeight).empty());
}

}  // namespace
}  // namespace skyfit
