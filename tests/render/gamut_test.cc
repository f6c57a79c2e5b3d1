// SPDX-License-Identifier: Apache-2.0
// No light of a frame is negative in any primaries; what a colour space cannot hold keeps its
// luminance and the direction of its hue, and the rest of the picture is the same light.
#include "render/image/gamut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/image/tone.h"
#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

constexpr double kMatrix = 1e-6;  // seven digits of the matrices
constexpr double kFloat = 2e-6;   // sums of floats

class GamutOf : public ::testing::TestWithParam<Primaries> {
 protected:
  const ColorSpace& space() const { return color_space(GetParam()); }
};

TEST_P(GamutOf, WhiteIsTheWhite) {
  const ColorChannels made =
      converted({0.95047, 1, 1.08883}, color_space(Primaries::kXyz), space());
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(made[k], space().white[k], kMatrix);
  EXPECT_NEAR(luminance_of(space().white, space()), 1, kMatrix);
}

TEST_P(GamutOf, LightOutsideKeepsLuminanceAndHue) {
  const ColorChannels outside = {5, 2, -0.7};
  const double luminance = luminance_of(outside, space());
  const ColorChannels mapped = into_gamut(outside, luminance, space().white);
  EXPECT_EQ(std::ranges::min(mapped), 0);
  EXPECT_NEAR(luminance_of(mapped, space()) / luminance, 1, kMatrix);
  const auto off = [&](const ColorChannels& color, std::size_t k) {
    return color[k] - luminance * space().white[k];
  };
  for (std::size_t k = 1; k < 3; ++k)
    EXPECT_NEAR(off(mapped, k) / off(mapped, 0), off(outside, k) / off(outside, 0), 1e-12);
}

TEST_P(GamutOf, LightInsideStaysAndDarknessIsDark) {
  const ColorChannels inside = {1, 0, 2};
  EXPECT_EQ(into_gamut(inside, 1, space().white), inside);
  EXPECT_EQ(into_gamut({-1e-9, 0, 0}, 0, space().white), (ColorChannels{0, 0, 0}));
}

// A setting sun, whose disc is redder than sRGB, with all layers.
TEST_P(GamutOf, FrameIsNotNegativeAndTheSameLight) {
  FrameOptions options = options_of("sunset", 96, 54);
  options.camera.view_zenith = options.sun_zenith = 88 * kDegree;
  options.camera.vertical_fov = 2 * kDegree;
  options.layers = true;
  const Frame srgb = renderer().draw(options);
  options.primaries = GetParam();
  const Frame frame = renderer().draw(options);
  EXPECT_EQ(frame.primaries, GetParam());
  EXPECT_EQ(frame.luminance, srgb.luminance);
  WorstPixel luminance, light;
  int outside = 0;
  const FrameLayers& layers = *frame.layers;
  for (std::size_t i = 0; i < frame.luminance.size(); ++i) {
    for (const auto* values : {&frame.rgb, &layers.in_scatter, &layers.reflected,
                               &layers.transmittance, &layers.albedo}) {
      for (std::size_t k = 0; k < 3; ++k) ASSERT_GE((*values)[3 * i + k], 0) << "pixel " << i;
    }
    const auto color = [i](const Frame& of) -> ColorChannels {
      return {of.rgb[3 * i], of.rgb[3 * i + 1], of.rgb[3 * i + 2]};
    };
    luminance.add(frame, i, luminance_of(color(frame), space()) / frame.luminance[i] - 1);
    if (std::ranges::min(color(srgb)) < kMatrix * frame.luminance[i]) {
      ++outside;
      continue;
    }
    const ColorChannels back = converted(color(frame), space(), color_space(Primaries::kRec709));
    for (std::size_t k = 0; k < 3; ++k)
      light.add(frame, i, (back[k] - color(srgb)[k]) / frame.luminance[i]);
  }
  luminance.print("luminance");
  light.print("light inside the gamut");
  std::printf("[ gamut  ] %d pixels are outside sRGB\n", outside);
  EXPECT_GT(outside, 50);
  EXPECT_LT(luminance.error(), kFloat);
  EXPECT_GT(light.count(), 3 * 96 * 20);
  EXPECT_LT(light.error(), 5 * kFloat);
  // A PNG is the same in all primaries.
  ToneOptions tone;
  tone.exposure = metered_exposure(srgb);
  const std::vector<std::uint8_t> png = tone_mapped(frame, tone),
                                  expected = tone_mapped(srgb, tone);
  int steps = 0;
  for (std::size_t i = 0; i < png.size(); ++i)
    steps = std::max(steps, std::abs(png[i] - expected[i]));
  EXPECT_LE(steps, 1);
}

INSTANTIATE_TEST_SUITE_P(Spaces, GamutOf,
                         ::testing::Values(Primaries::kRec709, Primaries::kRec2020,
                                           Primaries::kXyz));

}  // namespace
}  // namespace skyfit
