// SPDX-License-Identifier: Apache-2.0
// Depth leads back to the surface, from 1 m above it to ten radii, with the digits of a float: d of
// a plane is its height / cos of the view's angle.
#include <gtest/gtest.h>

#include <cmath>

#include "model/atmosphere/lowered_ground.h"
#include "tests/render/mesh_fixture.h"

namespace skyfit {
namespace {

// Depth near / d, a division and a multiplication in the shader, the distance as a float; 6e-8
// each.
constexpr double kFloatDepth = 4e-7;
// Rows of triangles of the moon's sphere: an arrow of (pi / 128)^2 / 8, and of the columns.
constexpr double kMoonsTriangles = 3e-4;  // of its radius

class Altitudes : public ::testing::TestWithParam<double> {};

TEST_P(Altitudes, DepthLeadsBackToTheGround) {
  const double above = GetParam();
  const double bottom = earth_clear().atmosphere.bottom_radius_m;
  const double albedo = earth_clear().atmosphere.ground_albedo;
  const Relief ground(bottom, {albedo, albedo, albedo, albedo}, true);
  const double altitude = std::max(renderer().ground_height_m({}), 0.0) + above;
  // The planet from afar fills the picture.
  const double fov = std::min(0.9, 2 * std::asin(bottom / (bottom + altitude)));
  int checked = 0;
  for (const double zenith : {100.0, 135.0, 180.0}) {
    FrameOptions options = options_at({altitude, zenith * kDegree, 0.5, fov}, 1, 96, 60);
    options.samples_per_quad = 1;
    const Frame frame = renderer().draw(options);
    WorstPixel worst;
    for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
      if (is_sky(frame, i)) continue;
      const double d = frame.depth_m[i];
      const glm::dvec3 p = d * ray_of(frame, i) + glm::dvec3(0, 0, bottom + altitude);
      const double footprint = d * options.camera.vertical_fov / frame.height;
      const double height =
          ground.height_m(glm::normalize(coast().planet_from_site() * p), 2 * footprint);
      const double error = std::abs(glm::length(p) - bottom - height);
      // A quad is as large as a pixel; the finest ones are 0.3 m.
      worst.add(frame, i, error / (0.3 + 2 * footprint + 1e-6 * d));
      ++checked;
    }
    std::printf("[  worst ] %g m, zenith %g: %s of the tolerance\n", above, zenith,
                worst.text().c_str());
    EXPECT_LT(worst.error(), 1);
  }
  EXPECT_GT(checked, 1000);
}

INSTANTIATE_TEST_SUITE_P(FromTheGroundToTenRadii, Altitudes,
                         ::testing::Values(1.0, 10.0, 100.0, 1e3, 1e4, 1e5, 1e6, 6.36e6, 6.36e7));

TEST(Depth, HasTheDigitsOfAFloatFromOneMetreToTheMoon) {
  constexpr std::array kDistances = {1.0, 1e3, 1e6, 384.4e6};
  constexpr double kAltitude = 10;
  const TemporaryDirectory directory;
  Scene scene;
  for (std::size_t i = 0; i < kDistances.size(); ++i) {
    // Each a strip of the picture of its own.
    const auto file = directory.path() / ("plane" + std::to_string(i) + ".obj");
    const double left = -0.5 + 0.25 * static_cast<double>(i), right = left + 0.25;
    ObjWriter(file).quad(
        {glm::dvec3{-0.5, left, 0}, {-0.5, right, 0}, {0.5, right, 0}, {0.5, left, 0}});
    scene.meshes.push_back(at_the_coast(file, kAltitude + kDistances[i]));
    scene.meshes.back().scale = kDistances[i];
  }
  Renderer drawn = make_renderer(scene);
  FrameOptions options = options_at({kAltitude, 0, 0, 2 * std::atan(0.45)}, 1, 96, 96);
  const Frame frame = drawn.draw(options);
  std::array<WorstPixel, kDistances.size()> worst;
  for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
    ASSERT_FALSE(is_sky(frame, i)) << "pixel " << i;
    const double along = frame.depth_m[i] * std::cos(frame.view_zenith_deg[i] * kDegree);
    for (std::size_t k = 0; k < kDistances.size(); ++k) {
      if (std::abs(along / kDistances[k] - 1) < 0.5)
        worst[k].add(frame, i, along / kDistances[k] - 1);
    }
  }
  for (std::size_t k = 0; k < kDistances.size(); ++k) {
    std::printf("[  worst ] plane at %g m: %s\n", kDistances[k], worst[k].text().c_str());
    EXPECT_GT(worst[k].count(), 1000);
    EXPECT_LT(worst[k].error(), kFloatDepth);
  }
}

TEST(Depth, OfASphereIsTheDistanceAlongTheRay) {
  for (const double distance : {20.0, 1e3, 1e6, 384.4e6}) {
    FrameOptions options = options_at({100, 60 * kDegree, 2, 0.4}, 1, 64, 64);
    options.moon =
        Moon{options.camera.view_zenith, options.camera.azimuth, distance, 0.15 * distance, 0.1};
    const Frame frame = renderer().draw(options);
    const glm::dvec3 centre = distance * direction_to(options.moon->zenith, options.moon->azimuth);
    WorstPixel worst;
    for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
      const glm::dvec3 ray = ray_of(frame, i);
      const double along = glm::dot(ray, centre), radius = options.moon->radius_m;
      const double half_chord2 = radius * radius - glm::dot(centre, centre) + along * along;
      if (half_chord2 < 0.3 * radius * radius) continue;  // a grazed sphere is steep
      worst.add(frame, i, (frame.depth_m[i] - (along - std::sqrt(half_chord2))) / radius);
    }
    std::printf("[  worst ] sphere at %g m, of its radius: %s\n", distance, worst.text().c_str());
    EXPECT_GT(worst.count(), 800);
    EXPECT_LT(worst.error(), kMoonsTriangles * 2 + kFloatDepth * distance / options.moon->radius_m);
  }
}

// A planet whose whole ground lies 3 km below its bottom radius, and its sea there.
TEST(Depth, OfABasinReachesToItsOwnFloor) {
  const TemporaryDirectory directory;
  Scene scene;
  scene.height_map = directory.path() / "flat.pgm";
  std::ofstream map(scene.height_map);
  map << "P2 8 4 255";
  for (int i = 0; i < 8 * 4; ++i) map << " 0";
  map.close();
  scene.lowest_m = -8000;
  scene.water_level_m = -3000;
  Preset lowered = earth_clear();
  lowered.atmosphere = lowered_by(basin_depth_m(scene), lowered.atmosphere);
  Renderer drawn(scene);
  drawn.set_atmosphere(earth_clear(), tables_of(lowered, kSmallTables));
  EXPECT_NEAR(drawn.ground_height_m({}), -3000, 1e-6);
  for (const double above : {20.0, 2500.0, 4000.0}) {
    const FrameOptions options = options_at({above - 3000, 180 * kDegree, 0, 0.1}, 1, 16, 16);
    const Frame frame = drawn.draw(options);
    for (std::size_t i = 0; i < frame.depth_m.size(); ++i) {
      const double drop = frame.depth_m[i] * -std::cos(frame.view_zenith_deg[i] * kDegree);
      EXPECT_NEAR(drop, above, 1e-4 * above);
      EXPECT_GT(frame.luminance[i], 0);
    }
  }
  EXPECT_THROW(drawn.draw(options_at({-3001, 180 * kDegree, 0, 0.1}, 1, 16, 16)),
               std::invalid_argument);
}

// Cameras a centimetre apart of which one has other blocks than the other: the blocks' shapes have
// become those of the coarser level before it takes over.
TEST(Levels, ReplaceEachOtherWithoutAStep) {
  const auto at = [&](double altitude) {
    FrameOptions options = options_of("valley", 96, 60);
    options.camera.altitude_m += altitude;
    options.samples_per_quad = 4;
    return renderer().draw(options);
  };
  // Pixels whose light differs by more than 2 %, which one on a sharp ridge may do by itself.
  const auto different = [](const Frame& a, const Frame& b, WorstPixel& worst) {
    int count = 0;
    for (std::size_t i = 0; i < a.luminance.size(); ++i) {
      const double error = a.luminance[i] / b.luminance[i] - 1;
      worst.add(a, i, error);
      if (std::abs(error) > 0.02) ++count;
    }
    return count;
  };
  // Nodes of the tree that are leaves or not seen; a block that only leaves the picture stays one.
  const auto leaves = [](const Frame& frame) {
    const FrameStatistics& s = frame.statistics;
    return s.blocks_drawn + s.blocks_hidden + s.blocks_outside + s.blocks_behind;
  };
  int changes = 0, popped = 0, usual = 0;
  WorstPixel worst, quiet;
  for (double altitude = 0; altitude < 400; altitude += 40) {
    double low = altitude, high = altitude + 40;
    Frame below = at(low), above = at(high);
    if (leaves(below) == leaves(above)) continue;
    while (high - low > 0.01) {
      const double middle = 0.5 * (low + high);
      Frame between = at(middle);
      if (leaves(between) == leaves(below)) {
        low = middle, below = std::move(between);
      } else {
        high = middle, above = std::move(between);
      }
    }
    ++changes;
    popped += different(below, above, worst);
    usual += different(at(low - (high - low)), below, quiet);
  }
  std::printf("[ levels ] %d changes, %d pixels differ (%d without a change)\n", changes, popped,
              usual);
  worst.print("with a change");
  quiet.print("without one");
  ASSERT_GE(changes, 3);
  EXPECT_LE(popped, usual + changes);
}

}  // namespace
}  // namespace skyfit
