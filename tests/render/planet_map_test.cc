// SPDX-License-Identifier: Apache-2.0
// A map of the planet is a smooth function on the sphere: every direction finds its texel, there is
// no seam at the edges of the picture, a ramp stays a ramp, and coarser is smoother. What is no map
// is named in one line.
#include "render/gl/terrain/planet_map.h"

#include <gmock/gmock.h>

#include <fstream>
#include <limits>
#include <stdexcept>

#include "tests/render/map_fixture.h"

namespace skyfit {
namespace {

using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr auto kHeights = PlanetMap::Values::kHeights;
constexpr auto kColors = PlanetMap::Values::kColors;
constexpr double kHalfTurn = std::numbers::pi;
const OIIO::TypeDesc kFloat = OIIO::TypeDesc::FLOAT;

using PlanetMapFile = MapFiles;

// Not symmetric in any axis; -6..6 or so, so that a map of it holds (value + 6) / 12.
double slant(const glm::dvec3& d) { return d.x + 2 * d.y + 3 * d.z + 2 * d.x * d.y; }

std::vector<glm::dvec3> directions(int count) {
  std::mt19937 random(2);
  std::normal_distribution<double> normal;
  std::vector<glm::dvec3> list;
  for (int i = 0; i < count; ++i)
    list.push_back(glm::normalize(glm::dvec3(normal(random), normal(random), normal(random))));
  return list;
}

TEST_F(PlanetMapFile, EveryDirectionFindsItsTexel) {
  for (const bool cube : {false, true}) {
    double low = 1e9, high = -1e9;
    const auto file = write_globe("slant.tif", 96, cube, kFloat, [&](const glm::dvec3& d) {
      low = std::min(low, slant(d));
      high = std::max(high, slant(d));
      return slant(d);
    });
    const auto map = read_planet_map(file, kHeights);
    EXPECT_NEAR(map->texel_angle(), (cube ? 0.5 : 1.0) * kHalfTurn / 96, 1e-12);
    constexpr double kSpline = 4e-3;  // 12 * texel^2 / 6 of smoothing, and the one colour of a pole
    for (const glm::dvec3& d : directions(2000))
      ASSERT_NEAR(low + (high - low) * map->at(d, 0).value.x, slant(d), 12 * kSpline)
          << d.x << " " << d.y << " " << d.z << (cube ? " cube" : "");
  }
}

TEST_F(PlanetMapFile, OfOneValueLiesAtTheLowestHeight) {
  const auto file =
      write("level.png", 16, 8, 1, OIIO::TypeDesc::UINT8, std::vector<float>(16 * 8, 0.5f));
  const auto map = read_planet_map(file, kHeights);
  constexpr double kShorts = 1e-9 * 65535;  // sums of weights, of the stored values
  for (const glm::dvec3& d : directions(50)) EXPECT_NEAR(map->at(d, 0).value.x, 0, kShorts);
}

// Of all points a and b close together; `places` are those of the edges of the picture.
void expect_no_seam(const PlanetMap& map, const std::vector<glm::dvec3>& places, double texel) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  constexpr double kStep = 1e-6;
  for (const double angle : {0.0, 3 * texel, 7 * texel}) {
    for (const glm::dvec3& place : places) {
      const glm::dvec3 way = {normal(random), normal(random), normal(random)};
      const auto value = [&](double step) {
        return map.at(glm::normalize(place + step * way), angle).value.x;
      };
      const double before = value(-2 * kStep), left = value(-kStep), middle = value(0),
                   right = value(kStep), after = value(2 * kStep);
      const double most = 10 * kStep * glm::length(way) / texel;  // of a range of 1 over a texel
      ASSERT_NEAR(left, right, most) << place.x << " " << place.y << " " << place.z;
      // The slope is the same on both sides: no facet.
      constexpr double kCurvature = 40;  // of a spline over texels that differ by 1, per texel^2
      const double bend = (after - middle) - (middle - before);
      const double step = 2 * kStep * glm::length(way) / texel;
      ASSERT_NEAR(bend, 0, kCurvature * step * step + 1e-12)
          << place.x << " " << place.y << " " << place.z;
    }
  }
}

TEST_F(PlanetMapFile, HasNoSeamWhereTheLongitudesMeet) {
  const auto map = read_planet_map(write("noise.tif", 64, 32, 1, kFloat, noise(64 * 32)), kHeights);
  std::vector<glm::dvec3> places;
  for (double latitude = -1.4; latitude < 1.4; latitude += 0.05) {
    places.push_back(at(latitude, kHalfTurn));
    places.push_back(at(latitude, 0.3));
  }
  expect_no_seam(*map, places, map->texel_angle());
}

TEST_F(PlanetMapFile, HasNoSeamAtThePoles) {
  const auto map = read_planet_map(write("noise.tif", 64, 32, 1, kFloat, noise(64 * 32)), kHeights);
  expect_no_seam(*map, {{0, 0, 1}, {0, 0, -1}}, map->texel_angle());
  // From every side the same.
  for (const double pole : {1.0, -1.0}) {
    const double there = map->at({0, 0, pole}, 0).value.x;
    for (int i = 0; i < 12; ++i)
      EXPECT_NEAR(map->at(pole * at(0.5 * kHalfTurn - 1e-7, i), 0).value.x, there, 1e-6);
  }
}

TEST_F(PlanetMapFile, HasNoSeamAtTheEdgesOfACube) {
  const auto file = write("noise.tif", 6 * 32, 32, 1, kFloat, noise(6 * 32 * 32));
  const auto map = read_planet_map(file, kHeights);
  std::vector<glm::dvec3> places;
  for (int axis = 0; axis < 3; ++axis) {
    for (int sign = 0; sign < 4; ++sign) {
      for (double along = -1; along <= 1; along += 0.0625) {
        glm::dvec3 p(along);
        p[(axis + 1) % 3] = sign & 1 ? 1 : -1;
        p[(axis + 2) % 3] = sign & 2 ? 1 : -1;
        places.push_back(glm::normalize(p));
        p[(axis + 1) % 3] *= 1 - 2.0 / 32;  // where the neighbouring face fades in
        places.push_back(glm::normalize(p));
      }
    }
  }
  expect_no_seam(*map, places, map->texel_angle());
}

TEST_F(PlanetMapFile, ARampKeepsItsSlopeAndBecomesNoStairs) {
  // 16 bits, linear in latitude over a few thousand of the 65536 steps.
  constexpr int kRows = 128;
  const auto file = write_globe("ramp.png", kRows, false, OIIO::TypeDesc::UINT16,
                                [](const glm::dvec3& d) { return 0.5 + 0.1 * std::asin(d.z); });
  const auto map = read_planet_map(file, kHeights);
  const double rise =
      1.0 / ((kRows - 1) * map->texel_angle());  // the darkest is 0, the brightest 1
  constexpr double kStep = 1e-3;
  constexpr double kSixteenBits = 1.0 / (0.1 * kHalfTurn * 65535);  // of the ramp's range
  for (double latitude = -1; latitude < 1; latitude += 0.0173) {
    const auto low = map->at(at(latitude, 2 * latitude), 0);
    const auto high = map->at(at(latitude + kStep, 2 * latitude), 0);
    ASSERT_NEAR((high.value.x - low.value.x) / kStep, rise,
                1.5 * kSixteenBits / map->texel_angle());
    ASSERT_NEAR(low.slope, rise * map->texel_angle(), 0.02 * rise * map->texel_angle());
  }
}

TEST_F(PlanetMapFile, CoarserIsSmoother) {
  for (const int columns : {2 * 90, 6 * 90}) {  // 90, 45, 22, 11, 5 rows
    const auto file =
        write("noise.tif", columns, 90, 1, kFloat, noise(static_cast<std::size_t>(columns) * 90));
    const auto map = read_planet_map(file, kHeights);
    double before = 1e9;
    for (double angle = map->texel_angle(); angle < 1; angle *= 1.5) {
      double sum = 0, squares = 0;
      for (const glm::dvec3& d : directions(2000)) {
        const double value = map->at(d, angle).value.x;
        sum += value / 2000;
        squares += value * value / 2000;
      }
      EXPECT_NEAR(sum, 0.5, 0.03) << angle;
      const double deviation = std::sqrt(squares - sum * sum);
      EXPECT_LE(deviation, before * 1.001) << angle;
      before = deviation;
    }
    EXPECT_LT(before, 0.05);
    // Without a step between the copies.
    for (double angle = map->texel_angle(); angle < 1; angle *= 1.01) {
      const glm::dvec3 d = at(0.4, 1.1);
      ASSERT_NEAR(map->at(d, angle).value.x, map->at(d, 1.01 * angle).value.x, 0.02);
    }
  }
}

TEST_F(PlanetMapFile, ColorsAreLinear) {
  // sRGB 128 is 0.2158605 of white (IEC 61966-2-1); a checkerboard of black and white is half of
  // it.
  std::vector<float> grey(32 * 16 * 3, 128 / 255.0f), checks;
  for (int i = 0; i < 32 * 16; ++i) checks.insert(checks.end(), 3, (i + i / 32) % 2 ? 1.0f : 0.0f);
  const auto even =
      read_planet_map(write("grey.png", 32, 16, 3, OIIO::TypeDesc::UINT8, grey), kColors);
  for (const double angle : {0.0, 1.0}) {
    for (const glm::dvec3& d : directions(20)) {
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(even->at(d, angle).value[c], 0.2158605, 1e-6);
    }
  }
  const auto mixed =
      read_planet_map(write("checks.png", 32, 16, 3, OIIO::TypeDesc::UINT8, checks), kColors);
  constexpr double kEightBits = 0.005;  // a step of sRGB at 0.5
  EXPECT_NEAR(mixed->at(at(0.1, 1), 1).value[1], 0.5, kEightBits);
}

TEST_F(PlanetMapFile, WhatIsNoMapIsNamedInOneLine) {
  const auto error_of = [&](const std::filesystem::path& file, PlanetMap::Values values) {
    try {
      read_planet_map(file, values);
    } catch (const std::runtime_error& error) {
      EXPECT_THAT(error.what(), StartsWith(file.string() + ": "));
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      return std::string(error.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(error_of(directory_ / "missing.png", kHeights), HasSubstr("cannot be read: "));
  std::ofstream(directory_ / "text.png") << "not a picture";
  EXPECT_THAT(error_of(directory_ / "text.png", kHeights), HasSubstr("cannot be read: "));
  std::ofstream(directory_ / "empty.tif").close();
  EXPECT_THAT(error_of(directory_ / "empty.tif", kHeights), HasSubstr("cannot be read: "));
  EXPECT_THAT(error_of(write("wide.tif", 30, 10, 1, kFloat, noise(300)), kHeights),
              EndsWith("30 x 10 pixels: expected twice as wide as high, or six times for the faces "
                       "of a cube; --dem reads the heights of a region"));
  EXPECT_THAT(error_of(write("tiny.tif", 4, 2, 1, kFloat, noise(8)), kHeights),
              EndsWith("4 x 2 pixels: expected at least 4 rows"));
  EXPECT_THAT(error_of(write("grey.png", 16, 8, 1, OIIO::TypeDesc::UINT8, noise(128)), kColors),
              EndsWith("1 channel: expected red, green and blue"));
  std::vector<float> hole = noise(128);
  hole[2 * 16 + 5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THAT(error_of(write("hole.exr", 16, 8, 1, kFloat, hole), kHeights),
              EndsWith("nan in column 5 of row 2: expected finite values"));
  // A header that promises more than anybody wants to hold.
  std::ofstream(directory_ / "vast.hdr")
      << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 40000 +X 80000\n";
  EXPECT_THAT(error_of(directory_ / "vast.hdr", kHeights),
              EndsWith("80000 x 40000 pixels: expected at most 1e9"));
  // Half of a file.
  const auto whole = write("half.tif", 512, 256, 1, kFloat, noise(512 * 256));
  std::filesystem::resize_file(whole, std::filesystem::file_size(whole) / 2);
  EXPECT_THAT(error_of(whole, kHeights), HasSubstr("cannot be read: "));
}

}  // namespace
}  // namespace skyfit
