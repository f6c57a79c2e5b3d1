// SPDX-License-Identifier: Apache-2.0
// No light of a frame is negative in any primaries; what a colour space cannot hold keeps its
// luminance and the direction of its hue, and the rest of the picture is the same light.
#include "render/image/gamut.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "render/image/oklab.h"
#include "render/image/tone.h"
#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

constexpr double kMatrix = 1e-6;  // seven digits of the matrices
constexpr double kFloat = 2e-6;   // sums of floats

double hue_deg(const ColorChannels& color, const ColorSpace& space) {
  const Oklab lab = oklab_of(color, space);
  return std::atan2(lab.b, lab.a) / kDegree;
}

// Ottosson 2020, the table of examples: XYZ to L, a, b.
TEST(Oklab, IsThePublishedOne) {
  constexpr double kDigits = 1e-3;
  const auto expect = [&](const ColorChannels& xyz, const ColorChannels& lab) {
    const Oklab made = oklab_of(xyz, color_space(Primaries::kXyz));
    EXPECT_NEAR(made.l, lab[0], kDigits);
    EXPECT_NEAR(made.a, lab[1], kDigits);
    EXPECT_NEAR(made.b, lab[2], kDigits);
    const ColorChannels back = from_oklab(made, color_space(Primaries::kXyz));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(back[k], xyz[k], 1e-9);
  };
  expect({0.950, 1, 1.089}, {1, 0, 0});
  expect({1, 0, 0}, {0.450, 1.236, -0.019});
  expect({0, 1, 0}, {0.922, -0.671, 0.263});
  expect({0, 0, 1}, {0.153, -1.415, -0.449});
}

// Over four decades of exposure, of colours of the sky and of the primaries, outside sRGB as well;
// a display's colour without chroma has no hue.
TEST(ViewTransform, KeepsTheHueAndTheDisplaysRange) {
  constexpr double kHue = 3, kChroma = 0.003;  // degrees; below it 8 bits hold no hue
  const ColorSpace& srgb = color_space(Primaries::kRec709);
  double worst = 0;
  int coloured = 0;
  for (const ColorChannels& color : {ColorChannels{1, 0.4, 0.05},
                                     {1, 0.15, -0.04},
                                     {0.15, 0.35, 1},
                                     {0.02, 0.05, 1},
                                     {1, 1, 0.2},
                                     {0.2, 1, 0.1},
                                     {1, 0, 0},
                                     {0, 0, 1},
                                     {1, 0, 1},
                                     {0.9, 1, 1.1}}) {
    for (double exposure = 1e-2; exposure < 200; exposure *= 1.3) {
      for (const ToneCurve curve :
           {ToneCurve::kFilmic, ToneCurve::kExponential, ToneCurve::kClip}) {
        ColorChannels scene = into_gamut(color, luminance_of(color, srgb), srgb);
        for (double& channel : scene) channel *= exposure;
        ToneOptions tone;
        tone.curve = curve;
        const ColorChannels shown = display_light(scene, tone);
        EXPECT_GE(std::ranges::min(shown), 0);
        EXPECT_LE(std::ranges::max(shown), 1);
        const Oklab lab = oklab_of(shown, srgb);
        if (std::hypot(lab.a, lab.b) < kChroma) continue;
        ++coloured;
        const double turned = std::remainder(hue_deg(shown, srgb) - hue_deg(color, srgb), 360.0);
        worst = std::max(worst, std::abs(turned));
      }
    }
  }
  std::printf("[ hue    ] worst of %d: %.3g deg\n", coloured, worst);
  EXPECT_GT(coloured, 300);
  EXPECT_LT(worst, kHue);
}

// No contour where a channel becomes full: along a ramp of exposure no step of what is shown
// differs much from its neighbours.
TEST(ViewTransform, HasNoKinkAlongARamp) {
  constexpr double kStep = 1.01, kKink = 8e-4;
  for (const ColorChannels& color :
       {ColorChannels{1, 0.4, 0.05}, {0.15, 0.35, 1}, {1, 0.7, 0.4}, {0.9, 0.3, 0.2}}) {
    std::vector<ColorChannels> shown;
    for (double exposure = 0.05; exposure < 50; exposure *= kStep) {
      ColorChannels scene = color;
      for (double& channel : scene) channel *= exposure;
      shown.push_back(display_light(scene, {}));
    }
    double worst = 0;
    for (std::size_t i = 1; i + 1 < shown.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k)
        worst = std::max(worst, std::abs(shown[i - 1][k] - 2 * shown[i][k] + shown[i + 1][k]));
    }
    std::printf("[ ramp   ] worst second difference %.2g\n", worst);
    EXPECT_LT(worst, kKink);
  }
}

// Films and eyes see lights of a hundred times white as white.
TEST(ViewTransform, VeryBrightLightIsWhite) {
  for (const ColorChannels& color : {ColorChannels{200, 80, 10}, {30, 70, 200}, {0, 300, 0}}) {
    EXPECT_GT(std::ranges::min(display_light(color, {})), 0.9);
  }
}

// The other transform does not keep it: the test of hues can fail.
TEST(ViewTransform, OfChannelsTurnsOrangeIntoYellow) {
  const ColorSpace& srgb = color_space(Primaries::kRec709);
  const ColorChannels orange = {20, 6, 0.5};
  ToneOptions tone;
  tone.transform = ViewTransform::kChannels;
  const ColorChannels shown = display_light(orange, tone);
  EXPECT_GT(hue_deg(shown, srgb) - hue_deg(orange, srgb), 20);
}

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
  const ColorChannels mapped = into_gamut(outside, luminance, space());
  EXPECT_EQ(std::ranges::min(mapped), 0);
  EXPECT_NEAR(luminance_of(mapped, space()) / luminance, 1, kMatrix);
  EXPECT_NEAR(hue_deg(mapped, space()), hue_deg(outside, space()), 1e-3);
}

TEST_P(GamutOf, LightInsideStaysAndDarknessIsDark) {
  const ColorChannels inside = {1, 0, 2};
  EXPECT_EQ(into_gamut(inside, 1, space()), inside);
  EXPECT_EQ(into_gamut({-1e-9, 0, 0}, 0, space()), (ColorChannels{0, 0, 0}));
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

// Without a curve each channel is what it was, up to the display's white.
TEST(ViewTransform, ClipCutsChannelsOff) {
  ToneOptions tone;
  tone.curve = ToneCurve::kClip;
  tone.transform = ViewTransform::kChannels;
  EXPECT_EQ(display_light({3, 1, 0.25}, tone), (ColorChannels{1, 1, 0.25}));
}

// A pixel half of a sky of 50 times white and half of black ground is half as light as the sky, not
// as white as their mean.
TEST(EdgePixel, IsMixedAsTheDisplayShowsItsParts) {
  Frame frame;
  frame.width = 2;
  frame.height = 1;
  frame.rgb = {50, 50, 50, 25, 25, 25};
  frame.luminance = {50, 25};
  ToneOptions tone;
  tone.exposure = 1;
  const std::vector<std::uint8_t> mean = tone_mapped(frame, tone);
  frame.edges = {{1, 0.5f, {50, 50, 50}, {0, 0, 0}}};
  const std::vector<std::uint8_t> parts = tone_mapped(frame, tone);
  EXPECT_GT(mean[3], 245);
  EXPECT_NEAR(parts[3], 188, 2);  // sRGB of half the display's light
  EXPECT_EQ(parts[0], mean[0]);
}

}  // namespace
}  // namespace skyfit
