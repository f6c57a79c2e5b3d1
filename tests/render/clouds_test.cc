// SPDX-License-Identifier: Apache-2.0
// Sheets of clouds cover what they should, hide and dim what lies behind them, in the order of
// their heights, whatever order they are given in.
#include "render/gl/atmosphere/clouds.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

constexpr double kFloatSum = 1e-5;     // sums and products of floats in another order
constexpr double kShadedSteps = 0.05;  // 32 steps, of small tables

TEST(Clouds, OfNoCoverAreNone) {
  for (const char* view : {"ground", "orbit"}) {
    FrameOptions options = options_of(view, 64, 40);
    const Frame without = renderer().draw(options);
    options.clouds = {CloudLayer{3000, 0, 1}};
    const Frame with = renderer().draw(options);
    EXPECT_EQ(with.rgb, without.rgb) << view;
    options.clouds = {CloudLayer{3000, 1, 0}};
    EXPECT_EQ(renderer().draw(options).rgb, without.rgb) << view;
  }
}

TEST(Clouds, ThatCoverAllHideTheSun) {
  FrameOptions options = options_at({2, 50 * kDegree, 0, 2 * kDegree}, 50 * kDegree, 33, 33);
  const double sun = renderer().draw(options).luminance[16 * 33 + 16];
  options.clouds = {CloudLayer{3000, 1, 1}};
  const Frame covered = renderer().draw(options);
  const double behind = covered.luminance[16 * 33 + 16], beside = covered.luminance[0];
  std::printf("[ clouds ] sun %.3g cd/m^2, behind the clouds %.3g, beside it %.3g\n", sun, behind,
              beside);
  EXPECT_NEAR(behind / beside, 1, 0.05);
}

// From 400 km, a field of view of 4 deg about the place where the sun sets on the ground: 0.3 of
// the sun's height.
TEST(Clouds, HaveNoEdgeWhereTheSunSets) {
  constexpr int kRows = 32;
  constexpr double kRow = 0.02;  // of the light of the row before
  FrameOptions options = options_at({400e3, 164 * kDegree, 0, 4 * kDegree}, 91 * kDegree, 8, kRows);
  options.clouds = {CloudLayer{5000, 1, 1}};
  const Frame frame = renderer().draw(options);
  double before = 0;
  for (int row = 0; row < kRows; ++row) {
    double light = 0;
    for (int x = 0; x < 8; ++x) light += frame.luminance[static_cast<std::size_t>(8 * row + x)];
    if (row > 0) {
      EXPECT_NEAR(light / before, 1, kRow) << "row " << row;
    }
    before = light;
  }
  EXPECT_GT(before, 0);
}

TEST(Clouds, CoverTheirShareOfThePlanet) {
  for (const double cover : {0.3, 0.5, 0.7}) {
    FrameOptions options =
        options_at({11e6, 180 * kDegree, 0, 38 * kDegree}, 30 * kDegree, 120, 120);
    const Frame without = draw_layers(options);
    options.clouds = {CloudLayer{3000, cover, 0.9}};
    const Frame with = draw_layers(options);
    // Near the nadir; farther out rays cross the sheet at a slant.
    constexpr double kNear = 30;  // pixels
    double all = 0, opacity = 0;
    for (std::size_t i = 0; i < with.luminance.size(); ++i) {
      const double x = static_cast<double>(i % 120) - 59.5, y = static_cast<double>(i / 120) - 59.5;
      if (std::hypot(x, y) > kNear) continue;
      ++all;
      opacity += 1 - luminance_of(with.layers->transmittance, i) /
                         luminance_of(without.layers->transmittance, i);
    }
    const double share = opacity / all / options.clouds[0].opacity;
    std::printf("[ clouds ] cover %.1f: %.3f of %.0f pixels\n", cover, share, all);
    EXPECT_NEAR(share, cover, 0.12);
  }
}

const CloudLayer kLow{2000, 0.5, 0.9}, kHigh{9000, 0.6, 0.5};

FrameOptions with_clouds(FrameOptions options, std::vector<CloudLayer> clouds) {
  options.clouds = std::move(clouds);
  return options;
}

// From below, between and above two sheets, and from orbit.
std::vector<FrameOptions> eyes() {
  std::vector<FrameOptions> all = {options_of("orbit", 64, 40)};
  for (const double altitude : {50.0, 5e3, 12e3})
    all.push_back(options_at({altitude, 85 * kDegree, 0.3, 1.2}, 60 * kDegree, 64, 40));
  return all;
}

TEST(SlowTwoSheets, AreTheSameInEitherOrder) {
  for (const FrameOptions& options : eyes()) {
    const Frame a = draw_layers(with_clouds(options, {kLow, kHigh})),
                b = draw_layers(with_clouds(options, {kHigh, kLow}));
    EXPECT_EQ(a.rgb, b.rgb) << options.camera.altitude_m << " m";
    EXPECT_EQ(a.layers->transmittance, b.layers->transmittance);
  }
}

TEST(SlowTwoSheets, OfNoOpacityAreNone) {
  for (const FrameOptions& options : eyes()) {
    const Frame without = draw_layers(options);
    EXPECT_EQ(draw_layers(with_clouds(options, {{2000, 1, 0}, {9000, 0.5, 0}})).rgb, without.rgb)
        << options.camera.altitude_m << " m";
    // One of them leaves the other as it is alone.
    EXPECT_EQ(draw_layers(with_clouds(options, {kLow, {9000, 0.5, 0}})).rgb,
              draw_layers(with_clouds(options, {kLow})).rgb);
  }
}

TEST(SlowTwoSheets, LetPassTheProductOfWhatEachDoes) {
  for (const FrameOptions& options : eyes()) {
    const auto passed = [&](std::vector<CloudLayer> clouds) {
      return draw_layers(with_clouds(options, std::move(clouds))).layers->transmittance;
    };
    const std::vector<float> none = passed({}), low = passed({kLow}), high = passed({kHigh}),
                             both = passed({kLow, kHigh});
    int dimmed = 0;
    for (std::size_t i = 0; i < both.size(); ++i) {
      if (none[i] <= 0) continue;
      const double product = double{low[i]} * high[i] / none[i];
      EXPECT_NEAR(both[i], product, kFloatSum) << options.camera.altitude_m << " m, value " << i;
      dimmed += low[i] < 0.9f * none[i] && high[i] < 0.9f * none[i] ? 1 : 0;
    }
    std::printf("[ sheets ] %g m: %d values dimmed by both\n", options.camera.altitude_m, dimmed);
    // Between them a ray meets both only where it passes below the eye and rises again.
    if (std::abs(options.camera.altitude_m - 5e3) > 1) {
      EXPECT_GT(dimmed, 100);
    }
  }
}

TEST(TwoSheets, BetweenThemAreTheSameInEitherOrder) {
  const FrameOptions options = options_at({5e3, 85 * kDegree, 0.3, 1.2}, 60 * kDegree, 48, 32);
  EXPECT_EQ(draw_layers(with_clouds(options, {kLow, kHigh})).rgb,
            draw_layers(with_clouds(options, {kHigh, kLow})).rgb);
}

TEST(TwoSheets, HideTheFartherBehindTheNearer) {
  const CloudLayer closed_low{2000, 1, 1}, closed_high{9000, 1, 1};
  // From above the high one hides all.
  FrameOptions above = options_at({12e3, 140 * kDegree, 0.3, 0.8}, 40 * kDegree, 48, 32);
  const Frame two = draw_layers(with_clouds(above, {closed_low, closed_high})),
              one = draw_layers(with_clouds(above, {closed_high}));
  for (std::size_t i = 0; i < two.luminance.size(); ++i)
    EXPECT_NEAR(two.luminance[i] / one.luminance[i], 1, kFloatSum) << "pixel " << i;
  // From below the low one, which the high one shades: its light is the sky's alone.
  FrameOptions below = options_at({50, 40 * kDegree, 2, 0.8}, 40 * kDegree, 48, 32);
  const Frame alone = draw_layers(with_clouds(below, {closed_low})),
              shaded = draw_layers(with_clouds(below, {closed_low, closed_high}));
  EXPECT_EQ(alone.layers->transmittance, shaded.layers->transmittance);
  for (std::size_t i = 0; i < alone.luminance.size(); ++i) {
    EXPECT_LT(luminance_of(shaded.layers->reflected, i), luminance_of(alone.layers->reflected, i));
    EXPECT_GT(luminance_of(shaded.layers->reflected, i), 0);
  }
  // From between each hides what lies beyond it, and the low one is shaded.
  FrameOptions between = options_at({5e3, 140 * kDegree, 0.3, 0.8}, 40 * kDegree, 48, 32);
  const Frame down = draw_layers(with_clouds(between, {closed_low, closed_high})),
              lit = draw_layers(with_clouds(between, {closed_low}));
  between.camera.view_zenith = 40 * kDegree;
  between.camera.azimuth = 2;
  const Frame up = draw_layers(with_clouds(between, {closed_low, closed_high}));
  const Frame high = draw_layers(with_clouds(between, {closed_high}));
  for (std::size_t i = 0; i < up.luminance.size(); ++i)
    EXPECT_NEAR(up.luminance[i] / high.luminance[i], 1, kFloatSum) << "pixel " << i;
  for (std::size_t i = 0; i < down.luminance.size(); ++i)
    EXPECT_LT(down.luminance[i], 0.8 * lit.luminance[i]);
}

TEST(SlowTwoSheets, ShadeTheGroundByTheProductOfWhatEachDoes) {
  const FrameOptions options = options_at({1500, 110 * kDegree, 2, 1}, 50 * kDegree, 64, 40);
  const auto direct = [&](std::vector<CloudLayer> clouds) {
    return draw_layers(with_clouds(options, std::move(clouds))).layers->direct;
  };
  const std::vector<float> none = direct({}), low = direct({kLow}), high = direct({kHigh}),
                           both = direct({kLow, kHigh});
  int shaded = 0;
  for (std::size_t i = 0; i < both.size() / 3; ++i) {
    const double lit = luminance_of(none, i);
    if (lit < 10) continue;
    const double product = luminance_of(low, i) * luminance_of(high, i) / lit;
    EXPECT_NEAR(luminance_of(both, i) / lit, product / lit, 1e-4) << "pixel " << i;
    shaded += product < 0.5 * lit ? 1 : 0;
  }
  EXPECT_GT(shaded, 20);
}

// Light that met the air once alone, so that none is left below a deck that no beam gets through.
TEST(SlowCloudShadows, LeaveNoSingleScatteringBelowAClosedDeck) {
  Renderer& with = renderer();
  with.set_atmosphere(earth_clear(), compute_tables(earth_clear().atmosphere,
                                                    color_rule(refs::standard_spectral_data()),
                                                    kSmallTables, 2, {}, {.orders = 1}));
  for (const double zenith : {40.0, 86.0}) {
    FrameOptions options = with_clouds(
        options_at({300, zenith * kDegree, 1, 0.1}, 50 * kDegree, 8, 8), {{2000, 1, 1}});
    const Frame lit = draw_layers(options, with);
    options.shadows = true;
    const Frame shaded = draw_layers(options, with);
    double most = 0;
    for (std::size_t i = 0; i < lit.luminance.size(); ++i)
      most = std::max(most, luminance_of(shaded.layers->in_scatter, i) /
                                luminance_of(lit.layers->in_scatter, i));
    std::printf("[ shade  ] %.3g of the light at %g deg is left\n", most, zenith);
    EXPECT_LT(most, kShadedSteps) << zenith;
  }
  with.set_atmosphere(earth_clear(), small_tables());
}

// Shadows take light away, the more the more clouds there are, and none without clouds.
TEST(CloudShadows, TakeLightAndNeverAddIt) {
  FrameOptions options = with_clouds(options_at({1500, 84 * kDegree, 0.3, 1}, 70 * kDegree, 48, 32),
                                     {{3000, 0.5, 0.9}});
  const Frame lit = draw_layers(options);
  options.shadows = true;
  const Frame shaded = draw_layers(options);
  int darker = 0;
  for (std::size_t i = 0; i < lit.luminance.size(); ++i) {
    const double before = luminance_of(lit.layers->in_scatter, i),
                 after = luminance_of(shaded.layers->in_scatter, i);
    EXPECT_LE(after, before * (1 + kFloatSum)) << "pixel " << i;
    darker += after < 0.95 * before ? 1 : 0;
  }
  std::printf("[ shade  ] %d of %zu pixels are darker by 5 %%\n", darker, lit.luminance.size());
  EXPECT_GT(darker, 100);
  const Frame terrain_alone = draw_layers(with_clouds(options, {}));
  EXPECT_EQ(draw_layers(with_clouds(options, {{3000, 0.5, 0}})).rgb, terrain_alone.rgb);
}

TEST(TwoSheets, OfOneHeightAreRefused) {
  FrameOptions options = with_clouds({}, {{3000, 0.5, 0.9}, {3000.5, 0.2, 0.9}});
  try {
    validate(options);
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "render.clouds.altitude_m = 3000.5: must be at least 1 m from that of every other "
                 "sheet");
  }
  options.clouds.assign(5, {});
  EXPECT_THROW(validate(options), std::invalid_argument);
}

// Gradient noise is 0 at the points of its lattice: octaves that share them would leave holes
// there.
TEST(CloudNoise, HasItsDeviationAtTheLatticePointsOfItsLongestOctave) {
  const std::vector<std::uint16_t> texels = cloud_noise();
  constexpr int kSide = 64, kLattice = 3;
  ASSERT_EQ(texels.size(), std::size_t{kSide} * kSide * kSide);
  const auto at = [&](int x, int y, int z) {
    const auto texel = [](int k) {
      return static_cast<std::size_t>(std::lround(1.0 * k * kSide / kLattice)) % kSide;
    };
    return texels[(texel(z) * kSide + texel(y)) * kSide + texel(x)] / 65535.0 - 0.5;
  };
  double square = 0;
  for (int i = 0; i < kLattice * kLattice * kLattice; ++i) {
    const double deviation = at(i % 3, i / 3 % 3, i / 9);
    square += deviation * deviation / (kLattice * kLattice * kLattice);
  }
  std::printf("[  noise ] deviation at lattice points %.3f of 0.167\n", std::sqrt(square));
  EXPECT_GT(std::sqrt(square), 0.5 / 6);
}

}  // namespace
}  // namespace skyfit
