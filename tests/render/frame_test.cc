// SPDX-License-Identifier: Apache-2.0
// Every named view is a whole photometric picture: no holes, directions and depths that lead back
// to the terrain, the sun's disc where the sun is; bad options are refused.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <stdexcept>

#include "model/tables/table_lookup.h"
#include "render/gl/terrain/relief.h"
#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

using ::testing::HasSubstr;

const AtmosphereTables& tables() { return small_tables(); }
const Preset& preset() { return earth_clear(); }

constexpr double kHighestPeak = 9e3;  // m

class EveryView : public ::testing::TestWithParam<std::tuple<std::string, double>> {};

TEST_P(EveryView, HasNoHoles) {
  const auto& [view, sun] = GetParam();
  FrameOptions options = options_of(view, 160, 100);
  options.sun_zenith = sun * kDegree;
  const Frame frame = renderer().draw(options);
  const double bottom = preset().atmosphere.bottom_radius_m;
  const double top = preset().atmosphere.top_radius_m;
  const double r = bottom + options.camera.altitude_m;
  EXPECT_GT(frame.statistics.triangles, 0);
  EXPECT_GT(frame.statistics.blocks_drawn, 0);
  for (std::size_t i = 0; i < frame.luminance.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k)
      ASSERT_TRUE(std::isfinite(frame.rgb[3 * i + k])) << "pixel " << i;
    ASSERT_TRUE(std::isfinite(frame.luminance[i])) << "pixel " << i;
    const double zenith = frame.view_zenith_deg[i] * kDegree;
    const double nearest = zenith < std::numbers::pi / 2 ? r : r * std::sin(zenith);
    const bool air = r < top || (zenith > std::numbers::pi / 2 && nearest < top - 20e3);
    if (air && (r < top || sun == 0) && sun <= 90) {  // the night side is dark
      EXPECT_GT(frame.luminance[i], 0) << "pixel " << i;
    }
    // Rays that point well below the horizon end on the ground.
    const double pixel = r * options.camera.vertical_fov / frame.height;
    if (zenith > std::numbers::pi / 2 && nearest < bottom - 1e3 - pixel) {
      EXPECT_TRUE(std::isfinite(frame.depth_m[i])) << "pixel " << i;
    }
    // Rays that miss the planet see the sky.
    const bool sky = zenith < 60 * kDegree || nearest > bottom + kHighestPeak + pixel;
    if (sky && r > bottom + kHighestPeak) {
      EXPECT_TRUE(std::isinf(frame.depth_m[i])) << "pixel " << i;
    }
  }
}

class EveryPlace : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryPlace, DepthLeadsBackToTheTerrain) {
  FrameOptions options = options_of(GetParam(), 160, 100);
  options.samples_per_quad = 1;
  const Frame frame = renderer().draw(options);
  const double bottom = preset().atmosphere.bottom_radius_m;
  const double albedo = preset().atmosphere.ground_albedo;
  const Relief relief(bottom, {albedo, albedo, albedo, albedo}, true);
  const SiteAxes axes = options.site ? site_axes(*options.site) : relief.coast();
  int checked = 0, good = 0;
  for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
    const double d = frame.depth_m[i];
    if (!std::isfinite(d)) continue;
    const glm::dvec3 p =
        d * ray_of(frame, i) + glm::dvec3(0, 0, bottom + options.camera.altitude_m);
    const glm::dvec3 from_centre = axes.planet_from_site() * p;
    const double footprint = d * options.camera.vertical_fov / frame.height;
    const double height = relief.height_m(glm::normalize(from_centre), 2 * footprint);
    ++checked;
    // A quad is as large as a pixel; rays graze the ground, so two footprints of height are what
    // the picture resolves.
    if (std::abs(glm::length(from_centre) - bottom - height) < 1 + 2 * footprint + 1e-6 * d) ++good;
  }
  std::printf("[  share ] %d of %d pixels lie on the terrain\n", good, checked);
  ASSERT_GT(checked, 500);
  EXPECT_GT(good, 0.97 * checked);
}

INSTANTIATE_TEST_SUITE_P(Views, EveryPlace,
                         ::testing::Values("ground", "sunset", "away", "valley", "10km", "orbit",
                                           "limb", "space"));
INSTANTIATE_TEST_SUITE_P(Views, EveryView,
                         ::testing::Combine(::testing::Values("ground", "sunset", "away", "valley",
                                                              "10km", "orbit", "limb", "space"),
                                            ::testing::Values(0.0, 60.0, 85.0, 90.0, 110.0)));

TEST(Frame, NormalsAreUnitVectorsAndAlbedosPhysical) {
  FrameOptions options = options_of("10km", 160, 100);
  options.layers = true;
  const Frame frame = renderer().draw(options);
  ASSERT_TRUE(frame.layers);
  for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
    const glm::dvec3 normal = color_of(frame.layers->normal, i),
                     albedo = color_of(frame.layers->albedo, i);
    if (is_sky(frame, i)) {
      EXPECT_EQ(normal, glm::dvec3(0));
      EXPECT_EQ(albedo, glm::dvec3(0));
      continue;
    }
    EXPECT_NEAR(glm::length(normal), 1, 1e-6);
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(albedo[k], 0);
      EXPECT_LE(albedo[k], 1.01);
    }
  }
}

TEST(Frame, TheSunsDiscCarriesItsIlluminance) {
  FrameOptions options;
  options.width = options.height = 201;
  options.samples_per_side = 4;
  options.camera = {2, 60 * kDegree, 0, 2 * kDegree};
  options.sun_zenith = 60 * kDegree;
  const Frame frame = renderer().draw(options);
  double disc = 0;
  const double pixel = std::pow(2 * std::tan(1 * kDegree) / 201, 2);
  for (const float luminance : frame.luminance) disc += luminance > 1e6f ? luminance * pixel : 0;
  // Direct normal illuminance through the atmosphere's optical depth.
  const NodeValues tau = lookup_optical_depth(tables(), 2, 0.5);
  double expected = 0;
  for (std::size_t k = 0; k < 4; ++k)
    expected += tables().color.xyz_from_nodes[1][k] * std::exp(-tau[k]);
  EXPECT_NEAR(disc / expected, 1, 0.01);
  const auto brightest =
      std::max_element(frame.luminance.begin(), frame.luminance.end()) - frame.luminance.begin();
  EXPECT_NEAR(frame.view_zenith_deg[static_cast<std::size_t>(brightest)], 60, 0.1);
  EXPECT_NEAR(frame.view_azimuth_deg[static_cast<std::size_t>(brightest)], 0, 0.1);
}

TEST(Frame, WithoutAirNothingIsScattered) {
  Preset airless = earth_clear();
  airless.atmosphere.constituents.clear();
  Renderer drawn;
  drawn.set_atmosphere(airless, tables_of(airless, kSmallTables));
  for (const char* view : {"limb", "space"}) {
    FrameOptions options = options_at(find_view(view).camera, find_view(view).sun_zenith, 48, 30);
    options.layers = true;
    const Frame frame = drawn.draw(options);
    int skies = 0;
    for (std::size_t i = 0; i < frame.luminance.size(); ++i) {
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_EQ(frame.layers->in_scatter[3 * i + c], 0) << view << ", pixel " << i;
      if (is_sky(frame, i)) ++skies;
    }
    EXPECT_GT(skies, 50) << view;
  }
}

TEST(Frame, MirrorsAboutTheSunsAzimuthInTheSky) {
  FrameOptions options = options_of("ground", 160, 100);
  const Frame frame = renderer().draw(options);
  int compared = 0;
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 80; ++x) {
      const auto left = static_cast<std::size_t>(y * 160 + x),
                 right = static_cast<std::size_t>(y * 160 + 159 - x);
      if (std::isfinite(frame.depth_m[left]) || std::isfinite(frame.depth_m[right])) continue;
      EXPECT_NEAR(frame.luminance[left] / frame.luminance[right], 1, 1e-3);
      ++compared;
    }
  }
  EXPECT_GT(compared, 1000);
}

// Halves round by 1/2048 of their distance from the largest logarithm, light that matters lies
// within 4 of it; 8 bits have 255 steps over the logarithms' whole range, some 20. The last shows
// that the renderer is left as it was.
TEST(Frame, TablesOfFewerBitsAreAsFarOffAsTheirSteps) {
  const FrameOptions options = options_of("10km", 48, 30);
  const Frame frame = renderer().draw(options);
  const auto off = [&](TablePrecision precision) {
    renderer().set_atmosphere(earth_clear(), small_tables(), precision);
    const Frame other = renderer().draw(options);
    WorstPixel worst;
    for (std::size_t i = 0; i < frame.luminance.size(); ++i)
      worst.add(frame, i, other.luminance[i] / frame.luminance[i] - 1);
    worst.print(precision == TablePrecision::k8Bit ? "8 bits" : "float or half");
    return worst;
  };
  const WorstPixel half = off(TablePrecision::kHalf), steps = off(TablePrecision::k8Bit);
  EXPECT_GT(half.error(), 0);
  EXPECT_LT(half.error(), 4.0 / 2048);
  EXPECT_GT(steps.rms(), half.rms());
  EXPECT_LT(steps.error(), 0.5 * 20 / 255);
  EXPECT_EQ(off(TablePrecision::kFloat).error(), 0);
}

TEST(Options, AreRefusedWithNameValueAndRange) {
  const auto refusal = [](FrameOptions options) -> std::string {
    try {
      validate(options);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  FrameOptions options;
  EXPECT_EQ(refusal(options), "accepted");
  options.width = 0;
  EXPECT_EQ(refusal(options), "render.width = 0: must be 1 to 16384 pixels");
  options.width = -5;
  EXPECT_EQ(refusal(options), "render.width = -5: must be 1 to 16384 pixels");
  options.width = 100'000;
  EXPECT_EQ(refusal(options), "render.width = 100000: must be 1 to 16384 pixels");
  options.width = options.height = 16384;
  EXPECT_THAT(refusal(options), HasSubstr("must be at most 67108864 pixels"));
  options = {};
  options.camera.altitude_m = std::nan("");
  EXPECT_THAT(refusal(options), HasSubstr("render.camera.altitude_m = nan"));
  options = {};
  options.camera.vertical_fov = 0;
  EXPECT_THAT(refusal(options), HasSubstr("render.camera.vertical_fov = 0"));
}

TEST(Views, AreFoundByNameOrListed) {
  EXPECT_EQ(find_view("10km").camera.altitude_m, 10e3);
  try {
    find_view("moon");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_STREQ(error.what(),
                 "view \"moon\": expected one of "
                 "ground, sunset, away, valley, 10km, orbit, limb, space");
  }
}

// Of each column the height of the sky, in pixels, with the shares of the pixels on the line.
std::vector<double> sky_heights(const Frame& frame) {
  std::vector<double> sky(frame.depth_m.size()), heights(static_cast<std::size_t>(frame.width), 0);
  for (std::size_t i = 0; i < sky.size(); ++i) sky[i] = is_sky(frame, i) ? 1 : 0;
  for (const EdgePixel& edge : frame.edges) sky[edge.pixel] = double{edge.sky_share};
  for (std::size_t i = 0; i < sky.size(); ++i) heights[i % heights.size()] += sky[i];
  return heights;
}

// The curved horizon from 100 km has the same place with one sample to a pixel as with 16, and no
// steps; without the shares it has.
TEST(Horizon, HasNoStepsAtAnySampling) {
  FrameOptions options = options_at({1e5, 100 * kDegree, 0.4, 0.6}, 60 * kDegree, 96, 64);
  const auto rms = [](const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return std::sqrt(sum / static_cast<double>(a.size()));
  };
  options.samples_per_side = 4;
  const std::vector<double> fine = sky_heights(renderer().draw(options));
  for (const int samples : {1, 2}) {
    options.samples_per_side = samples;
    Frame frame = renderer().draw(options);
    const double smooth = rms(sky_heights(frame), fine);
    frame.edges.clear();
    const double steps = rms(sky_heights(frame), fine);
    std::printf("[ line   ] %d samples: off by %.3f pixels rms, without shares %.3f\n",
                samples * samples, smooth, steps);
    EXPECT_LT(smooth, 0.12);
    EXPECT_GT(steps, 0.25);
  }
}

}  // namespace
}  // namespace skyfit
