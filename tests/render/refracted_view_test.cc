// SPDX-License-Identifier: Apache-2.0
// The horizon of a sea and the limb from space stand where Bouguer's law has them, the ground under
// a steep ray stays, and the light of ground and sky changes little.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "model/atmosphere/refraction.h"
#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kRows = 3201;  // of 0.0003 deg at a field of 1 deg

// Toward the sea.
FrameOptions looking(double height_m, double view_zenith, double field_of_view, bool refraction) {
  FrameOptions options =
      options_at({height_m, view_zenith, 0, field_of_view}, 50 * kDegree, 9, kRows);
  options.refraction = refraction;
  return options;
}

// In the picture's middle, from its lower edge; a row that is sky in part counts so.
double ground_rows(const Frame& frame) {
  double rows = 0;
  for (int y = 0; y < frame.height; ++y) {
    const std::size_t pixel = static_cast<std::size_t>(y) * frame.width + frame.width / 2;
    if (std::isfinite(frame.depth_m[pixel])) rows += 1;
  }
  return rows;
}

TEST(RefractedView, HorizonAndLimbStandWhereAirShowsThem) {
  const Atmosphere<double>& atmosphere = earth_clear().atmosphere;
  const Refraction refraction(atmosphere, 550);
  const double bottom = atmosphere.bottom_radius_m;
  for (const double height : {100.0, 3e3, 10e3, 400e3}) {
    const double straight = kPi - std::asin(bottom / (bottom + height)),
                 index = refraction.refractive_index(0) /
                         refraction.refractive_index(refraction.refractive_height(height)),
                 seen = kPi - std::asin(index * bottom / (bottom + height)), field = 1 * kDegree,
                 row = 2 * std::tan(0.5 * field) / kRows;
    double found[2];
    for (const bool bent : {false, true}) {
      const Frame frame = renderer().draw(looking(height, straight, field, bent));
      found[bent] = std::atan((ground_rows(frame) - 0.5 * kRows) * row);
    }
    std::printf("[ horizon] from %6g m: lifted by %.4f deg, by Bouguer's law %.4f\n", height,
                (found[1] - found[0]) / kDegree, (straight - seen) / kDegree);
    EXPECT_NEAR(found[0], 0, 1.5 * row);
    EXPECT_NEAR(found[1] - found[0], straight - seen, 0.02 * (straight - seen) + row);
  }
}

TEST(RefractedView, LightChangesLittle) {
  for (const double height : {2.0, 3e3, 400e3}) {
    const double zenith = height > 1e5 ? 115 * kDegree : 88 * kDegree;
    const Frame straight = renderer().draw(looking(height, zenith, 20 * kDegree, false)),
                bent = renderer().draw(looking(height, zenith, 20 * kDegree, true));
    int differ = 0;
    for (std::size_t pixel = 0; pixel < bent.luminance.size(); ++pixel) {
      ASSERT_TRUE(std::isfinite(bent.luminance[pixel]) && bent.luminance[pixel] >= 0);
      if (std::isfinite(bent.depth_m[pixel]) != std::isfinite(straight.depth_m[pixel])) continue;
      const double ratio = (bent.luminance[pixel] + 1) / (straight.luminance[pixel] + 1);
      if (std::abs(ratio - 1) > 0.05) ++differ;
    }
    // Those of waves and of the limb's slope.
    EXPECT_LT(differ, 0.02 * static_cast<double>(bent.luminance.size())) << height;
  }
}

}  // namespace
}  // namespace skyfit
