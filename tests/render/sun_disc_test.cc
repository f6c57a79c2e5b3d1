// SPDX-License-Identifier: Apache-2.0
// The sun's disc is round, in the light and on a display, and carries the direct illuminance,
// however small it is and wherever it stands in the picture; its limb is darker than its middle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "model/atmosphere/refraction.h"
#include "model/tables/table_lookup.h"
#include "render/image/glare.h"
#include "render/image/tone.h"
#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

constexpr double kSunZenith = 50 * kDegree;
constexpr double kRound = 0.02;  // of the radius at 8 pixels
constexpr double kIlluminance = 0.01;

double sun_radius() { return earth_clear().atmosphere.star.angular_radius_rad(); }

// A picture whose sun has a radius of so many pixels, so far off its middle.
FrameOptions looking_at_sun(double radius_px, double off_x_px, double off_y_px, int side) {
  const double pixel = std::tan(sun_radius()) / radius_px;  // of the picture's plane
  FrameOptions options =
      options_at({2, kSunZenith, 0, 2 * std::atan(0.5 * side * pixel)}, kSunZenith, side, side);
  options.camera.view_zenith += std::atan(off_y_px * pixel);
  options.camera.azimuth += std::atan(off_x_px * pixel) / std::sin(kSunZenith);
  return options;
}

double solid_angle(const Frame& frame, const FrameOptions& options, std::size_t pixel) {
  const double half = std::tan(0.5 * options.camera.vertical_fov), side = 2 * half / frame.height;
  const double x = side * (static_cast<double>(pixel % frame.width) + 0.5) - half,
               y = side * (static_cast<double>(pixel / frame.width) + 0.5) - half;
  return side * side * std::pow(1 + x * x + y * y, -1.5);
}

TEST(SunDisc, CarriesTheDirectIlluminance) {
  const NodeValues tau = lookup_optical_depth(small_tables(), 2, std::cos(kSunZenith));
  double expected = 0;
  for (std::size_t k = 0; k < 4; ++k)
    expected += small_tables().color.xyz_from_nodes[1][k] * std::exp(-tau[k]);
  for (const auto& [radius, off_x, off_y] : {std::tuple{0.3, 0.2, 0.4},
                                             {1.0, 0.3, 0.1},
                                             {1.0, 40.0, 40.0},
                                             {3.0, -30.0, 10.0},
                                             {8.0, 0.0, 0.0},
                                             {8.0, 30.3, 22.7},
                                             {20.0, 5.0, 0.0}}) {
    const FrameOptions options = looking_at_sun(radius, off_x, off_y, 100);
    const Frame frame = renderer().draw(options);
    double sum = 0;
    for (const DiscPixel& disc : frame.discs)
      sum += disc.luminance * solid_angle(frame, options, disc.pixel);
    std::printf("[ disc   ] radius %g px at (%g, %g): %.3f %% off\n", radius, off_x, off_y,
                100 * (sum / expected - 1));
    EXPECT_NEAR(sum / expected, 1, kIlluminance) << radius;
  }
}

// Where a picture of values between 0 and 1 falls below one half, along rays from a point.
struct Radii {
  double least = 1e9, most = 0, sum = 0;
  int count = 0;
  double mean() const { return sum / count; }
};
Radii radii(int side, double x, double y, double longest,
            const std::function<double(std::size_t)>& value) {
  const auto at = [&](double px, double py) {
    const double left = std::floor(px - 0.5), top = std::floor(py - 0.5);
    const double u = px - 0.5 - left, v = py - 0.5 - top;
    const auto texel = [&](int i, int j) {
      return value((static_cast<std::size_t>(top) + j) * side + static_cast<std::size_t>(left) + i);
    };
    return std::lerp(std::lerp(texel(0, 0), texel(1, 0), u), std::lerp(texel(0, 1), texel(1, 1), u),
                     v);
  };
  Radii found;
  for (int i = 0; i < 64; ++i) {
    const double turn = 2 * std::numbers::pi * i / 64;
    double r = 0;
    while (r < longest && at(x + r * std::cos(turn), y + r * std::sin(turn)) > 0.5) r += 0.01;
    found.least = std::min(found.least, r);
    found.most = std::max(found.most, r);
    found.sum += r;
    ++found.count;
  }
  return found;
}

TEST(SunDisc, IsRoundInTheLightAndOnADisplay) {
  constexpr int kSide = 48;
  constexpr double kRadius = 8;
  for (const int samples : {1, 2}) {
    for (const double off : {0.0, 0.37}) {
      FrameOptions options = looking_at_sun(kRadius, off, 0.5 * off, kSide);
      options.samples_per_side = samples;
      const Frame frame = renderer().draw(options);
      std::vector<double> cover(static_cast<std::size_t>(kSide) * kSide, 0);
      double x = 0, y = 0, area = 0;
      for (const DiscPixel& disc : frame.discs) {
        cover[disc.pixel] = disc.cover;
        area += disc.cover;
        x += disc.cover * (static_cast<double>(disc.pixel % kSide) + 0.5);
        y += disc.cover * (static_cast<double>(disc.pixel / kSide) + 0.5);
      }
      ToneOptions tone;
      tone.exposure = 1e-7;  // the disc is white, the sky black
      const std::vector<std::uint8_t> bytes = tone_mapped(frame, tone);
      const auto display = [&](std::size_t pixel) {
        const double level = bytes[3 * pixel + 1] / 255.0;
        return level <= 0.04045 ? level / 12.92 : std::pow((level + 0.055) / 1.055, 2.4);
      };
      const Radii light =
          radii(kSide, x / area, y / area, 20, [&](std::size_t pixel) { return cover[pixel]; });
      const Radii seen = radii(kSide, x / area, y / area, 20, display);
      std::printf("[ disc   ] %d samples: radius %.3f to %.3f px, on a display %.3f to %.3f\n",
                  samples * samples, light.least, light.most, seen.least, seen.most);
      for (const Radii& found : {light, seen}) {
        EXPECT_NEAR(found.least / kRadius, 1, kRound);
        EXPECT_NEAR(found.most / kRadius, 1, kRound);
      }
    }
  }
}

// The square that it is drawn in is cut off on three sides here.
TEST(SunDisc, OfAGiantStarIsLightAtEveryPixel) {
  Preset preset = earth_clear();
  preset.atmosphere.star.angular_diameter_deg = 6;
  FrameOptions options =
      options_at({2, kSunZenith - 2 * kDegree, 0, 3 * kDegree}, kSunZenith, 64, 48);
  options.samples_per_side = 2;
  const Frame frame = render_frame(preset, tables_of(preset, kSmallTables), options);
  EXPECT_FALSE(frame.discs.empty());
  for (std::size_t i = 0; i < frame.luminance.size(); ++i)
    EXPECT_TRUE(frame.luminance[i] >= 0 && std::isfinite(frame.luminance[i])) << "pixel " << i;
}

// 1 - u1 (1 - mu) - u2 (1 - mu)^2 over its mean, at the middle and at 0.9 of the radius.
TEST(SunDisc, HasADarkerLimb) {
  const FrameOptions options = looking_at_sun(22.5, 0, 0, 101);
  const Frame frame = renderer().draw(options);
  const auto [u1, u2] = earth_clear().atmosphere.star.limb_darkening;
  const auto profile = [&](double r) {
    const double fall = 1 - std::sqrt(1 - r * r);
    return 1 - u1 * fall - u2 * fall * fall;
  };
  const auto luminance = [&](int x) { return double{frame.luminance[50 * 101 + x]}; };
  const double off = 20 / 22.5;
  EXPECT_NEAR(luminance(70) / luminance(50), profile(off) / profile(0), 0.01);
  // Also in a picture exposed by itself.
  ToneOptions tone;
  tone.exposure = metered_exposure(frame);
  const auto bytes = tone_mapped(frame, tone);
  EXPECT_LT(bytes[3 * (50 * 101 + 70) + 1] + 10, bytes[3 * (50 * 101 + 50) + 1]);
}

// Upper and lower limb of a low sun stand where the bending of their own light has them, from the
// ground and from space, and the disc keeps its width.
TEST(SunDisc, IsFlatWhereAirRefractsIt) {
  constexpr int kSide = 301;
  const double radius = sun_radius();
  const Atmosphere<double>& atmosphere = earth_clear().atmosphere;
  const Refraction refraction(atmosphere, 550);
  const double pixel = 2 * std::tan(radius) / 100;  // the disc is 100 pixels wide without air
  for (const auto& [height_m, true_zenith] :
       {std::pair{2.0, 60 * kDegree}, {2.0, 88 * kDegree}, {2.0, 90 * kDegree}, {400e3, 0.0}}) {
    const double limb_of_planet =
        std::numbers::pi -
        std::asin(atmosphere.bottom_radius_m / (atmosphere.bottom_radius_m + 400e3));
    const double sun = true_zenith > 0 ? true_zenith : limb_of_planet + 0.2 * kDegree,
                 height = refraction.refractive_height(height_m);
    FrameOptions options = options_at(
        {height_m, refraction.apparent_zenith(height, sun), 0, 2 * std::atan(0.5 * kSide * pixel)},
        sun, kSide, kSide);
    options.refraction = true;
    const Frame frame = renderer().draw(options);
    std::vector<double> cover(static_cast<std::size_t>(kSide) * kSide, 0);
    for (const DiscPixel& disc : frame.discs) cover[disc.pixel] = disc.cover;
    double tall = 0, above = 0, wide = 0;
    for (int i = 0; i < kSide; ++i) {
      tall += cover[static_cast<std::size_t>(i) * kSide + kSide / 2];
      if (i < kSide / 2) above += cover[static_cast<std::size_t>(i) * kSide + kSide / 2];
      wide += cover[static_cast<std::size_t>(kSide / 2) * kSide + i];
    }
    const double seen = options.camera.view_zenith,
                 top = std::tan(seen - refraction.apparent_zenith(height, sun - radius)) / pixel,
                 bottom = std::tan(refraction.apparent_zenith(height, sun + radius) - seen) / pixel;
    std::printf("[ disc   ] %g m, %.2f deg: %.2f px tall, %.2f expected, %.2f wide\n", height_m,
                sun / kDegree, tall, top + bottom, wide);
    EXPECT_NEAR(tall, top + bottom, 0.5);
    EXPECT_NEAR(above + 0.5, top, 0.5);
    EXPECT_NEAR(wide, 100, 0.5);
    const bool low = sun > 85 * kDegree;
    EXPECT_LT(tall, (low ? 0.97 : 1.01) * wide);
  }
}

// Illuminance times the function of Vos & van den Berg 1999, eq. 8, far from the disc; and the
// function is about 10 / angle^2, the classic of Stiles & Holladay, where that holds.
TEST(Glare, FollowsTheGlareFunction) {
  FrameOptions options = options_at({2, kSunZenith, 0, 50 * kDegree}, kSunZenith, 96, 64);
  options.glare = Glare::kEye;
  const Frame frame = renderer().draw(options);
  ASSERT_EQ(frame.glare.size(), frame.rgb.size());
  const NodeValues tau = lookup_optical_depth(small_tables(), 2, std::cos(kSunZenith));
  double illuminance = 0;
  for (std::size_t k = 0; k < 4; ++k)
    illuminance += small_tables().color.xyz_from_nodes[1][k] * std::exp(-tau[k]);
  WorstPixel veil;
  for (std::size_t i = 0; i < frame.luminance.size(); ++i) {
    const double away =
        std::acos(glm::dot(ray_of(frame, i), direction_to(kSunZenith, 0))) / kDegree;
    if (away < 4) continue;
    veil.add(frame, i, luminance_of(frame.glare, i) / (illuminance * glare_function(away)) - 1);
  }
  veil.print("glare");
  EXPECT_GT(veil.count(), 3000);
  EXPECT_LT(veil.error(), 0.02);    // of the disc's place in its pixels
  constexpr double kClassic = 0.4;  // a fit of one power to three
  for (const double away : {3.0, 10.0, 30.0})
    EXPECT_NEAR(glare_function(away) * away * away / 10, 1, kClassic) << away;
  options.camera.azimuth = std::numbers::pi;
  EXPECT_TRUE(renderer().draw(options).glare.empty());
}

}  // namespace
}  // namespace skyfit
