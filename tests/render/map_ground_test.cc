// SPDX-License-Identifier: Apache-2.0
// The ground follows its maps: heights and their slope, flat water at its level, colours as
// reflectances; it is rough below the texels of the map, and no rougher than asked for.
#include "render/gl/terrain/map_ground.h"

#include <gmock/gmock.h>

#include <algorithm>

#include "data_refs/spectra.h"
#include "tests/render/map_fixture.h"

namespace skyfit {
namespace {

using ::testing::HasSubstr;

constexpr double kRadius = 6360e3;
const OIIO::TypeDesc kFloat = OIIO::TypeDesc::FLOAT;

using MapGroundFile = MapFiles;

const ColorRule& rule() {
  static const ColorRule made = color_rule(refs::standard_spectral_data());
  return made;
}

// Heights of -3000 m at the south pole to 5000 m at the north pole, linear in latitude.
Scene ramp(const std::filesystem::path& file) {
  Scene scene;
  scene.height_map = file;
  scene.lowest_m = -3000;
  scene.highest_m = 5000;
  return scene;
}

double latitude_of(const glm::dvec3& d) { return std::asin(d.z); }

TEST_F(MapGroundFile, HeightsAreThoseOfTheScene) {
  constexpr int kRows = 256;
  const MapGround ground(ramp(write_globe("ramp.tif", kRows, false, kFloat, latitude_of)), kRadius,
                         rule());
  const double coarse = 8 * std::numbers::pi * kRadius / kRows;  // no noise
  for (double latitude = 0.05; latitude < 1.2; latitude += 0.1) {
    const double expected = 1000 + 8000 * latitude / std::numbers::pi * kRows / (kRows - 1);
    EXPECT_NEAR(ground.height_m(at(latitude, 2), coarse), expected, 0.5);
    EXPECT_NEAR(ground.height_m(at(latitude, 2), 1), expected, 50);
  }
}

TEST_F(MapGroundFile, WaterIsFlatAtItsLevel) {
  Scene scene = ramp(write_globe("ramp.tif", 256, false, kFloat, latitude_of));
  scene.water_level_m = 500;
  const MapGround ground(scene, kRadius, rule());
  for (double latitude = -1.5; latitude < -0.3; latitude += 0.05) {
    const glm::dvec3 d = at(latitude, 1);
    EXPECT_EQ(ground.height_m(d, 0.1), 500);
    EXPECT_LT(ground.elevation(d, 0.1).above_water_m, 0);
  }
  const Elevation land = ground.elevation(at(0.5, 1), 0.1);
  EXPECT_GT(land.height_m, 500);
  EXPECT_EQ(land.above_water_m, land.height_m - 500);
}

// A map that shows the sea as flat: between the last water and the first land that are shown.
TEST_F(MapGroundFile, ACoastWithoutDepthsIsBetweenTexels) {
  constexpr int kRows = 512;
  const double texel = std::numbers::pi / kRows;
  Scene scene = ramp(write_globe("coast.tif", kRows, false, kFloat, [](const glm::dvec3& d) {
    return std::clamp(latitude_of(d), 0.0, 1.0);
  }));
  scene.lowest_m = 0;
  const MapGround ground(scene, kRadius, rule());
  for (const double resolution : {0.5, 2.9, 4.0, 5.4, 7.0, 16.0}) {  // texels
    const auto above = [&](double latitude) {
      return ground.elevation(at(latitude * texel, 1), resolution * texel * kRadius).above_water_m;
    };
    const double half = 0.5 * std::max(1.0, 0.5 * resolution);
    EXPECT_LE(above(-2 * half - 1), 0) << resolution;
    EXPECT_GT(above(2 * half + 1), 0) << resolution;
    int coasts = 0;  // one: no rim of land before it
    for (double at = -5 * half - 5; at < 5 * half + 5; at += 0.05 * half)
      coasts += above(at) <= 0 && above(at + 0.05 * half) > 0 ? 1 : 0;
    EXPECT_EQ(coasts, 1) << resolution;
  }
}

TEST_F(MapGroundFile, ASeaShownAsFlatStaysFlat) {
  Scene scene = ramp(write_globe("sea.png", 128, false, OIIO::TypeDesc::UINT8,
                                 [](const glm::dvec3& d) { return std::max(d.x, 0.0); }));
  scene.lowest_m = 0;
  const MapGround ground(scene, kRadius, rule());
  for (double longitude = 1.7; longitude < 4.5; longitude += 0.1)
    EXPECT_EQ(ground.height_m(at(0.2, longitude), 0.1), 0);
}

TEST_F(MapGroundFile, NoRougherThanAskedFor) {
  Scene scene = ramp(write("noise.tif", 512, 256, 1, kFloat, noise(512 * 256)));
  scene.lowest_m = 0;
  const MapGround ground(scene, kRadius, rule());
  // Second differences over the finest step, m.
  constexpr double kStep = 0.25;
  double before = 1e9;
  for (const double resolution : {0.1, 2.0, 20.0, 500.0, 2e4}) {
    double sum = 0;
    for (int i = 0; i < 2000; ++i) {
      const double latitude = 0.3 + 1e-4 * i, step = kStep / kRadius;
      const auto height = [&](int k) {
        return ground.height_m(at(latitude + k * step, 0.7), resolution);
      };
      const double bend = height(1) - 2 * height(0) + height(-1);
      sum += bend * bend;
    }
    EXPECT_LT(sum, before) << resolution;
    before = sum;
  }
  double highest = 0, difference = 0, mean = 0;
  for (int i = 0; i < 20000; ++i) {
    const glm::dvec3 d = at(std::sin(0.7 * i), i);
    const double fine = ground.height_m(d, 0.1), coarse = ground.height_m(d, 3e5);
    highest = std::max(highest, fine);
    difference += (fine - coarse) / 20000;
    mean += coarse / 20000;
  }
  EXPECT_LT(highest, ground.highest_m());
  EXPECT_LT(ground.highest_m(), 1.15 * scene.highest_m);
  EXPECT_NEAR(difference, 0, 0.02 * mean);  // detail adds no height
}

TEST_F(MapGroundFile, HeightIsContinuousInResolution) {
  Scene scene = ramp(write("noise.tif", 512, 256, 1, kFloat, noise(512 * 256)));
  const MapGround ground(scene, kRadius, rule());
  for (double resolution = 1; resolution < 1e6; resolution *= 1.01) {
    const glm::dvec3 d = at(0.4, 1.1);
    ASSERT_NEAR(ground.height_m(d, resolution), ground.height_m(d, 1.01 * resolution), 100)
        << resolution;
  }
}

TEST_F(MapGroundFile, ColorsAreReflectances) {
  Scene scene = ramp(write_globe("ramp.tif", 64, false, kFloat, latitude_of));
  // The northern half green, the southern half grey.
  std::vector<float> colors;
  for (int i = 0; i < 64 * 32; ++i) {
    const bool north = i < 64 * 16;
    colors.insert(colors.end(), {north ? 0.3f : 0.5f, 0.5f, north ? 0.2f : 0.5f});
  }
  scene.color_map = write("colors.tif", 64, 32, 3, kFloat, colors);
  const MapGround ground(scene, kRadius, rule());
  const NodeValues green = ground.reflectance(at(0.6, 1), 3000, 0, 10);
  const glm::dvec3 back = ColorReflectance(rule()).linear_srgb(green);
  EXPECT_LT(glm::length(back - glm::dvec3(0.3, 0.5, 0.2)), 1e-6);
  for (const double value : ground.reflectance(at(-0.6, 1), 0, 0, 10))
    EXPECT_NEAR(value, 0.5, 1e-6);
}

TEST_F(MapGroundFile, WithoutColorsSteepAndHighLandIsRock) {
  const MapGround ground(ramp(write_globe("ramp.tif", 64, false, kFloat, latitude_of)), kRadius,
                         rule());
  const glm::dvec3 d = at(0.5, 1);
  EXPECT_LT(ground.rock(d, 100, 0, 1), 0.1);
  EXPECT_EQ(ground.rock(d, 100, 0.3, 1), 1);
  EXPECT_EQ(ground.rock(d, 4800, 0, 1), 1);
  const NodeValues soil = ground.reflectance(d, 100, 0, 1),
                   stone = ground.reflectance(d, 4800, 0, 1);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_LT(soil[k], stone[k]);
}

TEST_F(MapGroundFile, AMissingMapIsNamed) {
  Scene scene = ramp(write_globe("ramp.tif", 64, false, kFloat, latitude_of));
  scene.color_map = directory_ / "missing.png";
  try {
    MapGround(scene, kRadius, rule());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("missing.png: cannot be read: "));
  }
}

}  // namespace
}  // namespace skyfit
