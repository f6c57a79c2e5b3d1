// SPDX-License-Identifier: Apache-2.0
// A frame shows the cone of an elevation model where it lies: straight down on it the distances are
// those to the cone, and beside it those to the sea.
#include <gtest/gtest.h>

#include "model/atmosphere/lowered_ground.h"
#include "tests/render/dem_fixture.h"
#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

using RegionalFrame = DemFiles;

TEST_F(RegionalFrame, ShowsTheConeWhereItLies) {
  const double radius = earth_clear().atmosphere.bottom_radius_m;
  constexpr double kLatitude = 46, kLongitude = 7, kSlope = 0.4, kTip = 2000, kAltitude = 12e3;
  const DemFile dem = {200, 200, {6.9, 0.001, 0, 46.1, 0, -0.001}};
  Scene scene = scene_of({write("cone.tif", dem, [&](double longitude, double latitude) {
    const double east = (longitude - kLongitude) * std::cos(kLatitude * kDegree);
    return kTip - kSlope * std::hypot(east, latitude - kLatitude) * kDegree * radius;
  })});
  scene.dem_surroundings = DemSurroundings::kSea;
  Renderer renderer = make_renderer(scene);
  const Site site = {kLatitude * kDegree, kLongitude * kDegree, 0};
  constexpr double kRounded = 100;  // m: the tip, over a cell of 111 m; and noise
  EXPECT_NEAR(renderer.ground_height_m(site), kTip, kRounded);
  // Without a place the camera stands in the middle of the map.
  EXPECT_EQ(renderer.ground_height_m(std::nullopt), renderer.ground_height_m(site));
  const Site beside = {(kLatitude + 0.03) * kDegree, kLongitude * kDegree, 0};
  EXPECT_NEAR(renderer.ground_height_m(beside), kTip - kSlope * 0.03 * kDegree * radius, 60);

  constexpr int kSide = 81;
  FrameOptions options;
  options.width = options.height = kSide;
  options.samples_per_side = 1;
  options.site = site;
  options.camera = {kAltitude, std::numbers::pi, 0, 1.0};
  options.sun_zenith = 0.8;
  const Frame frame = renderer.draw(options);
  const auto depth = [&](int row) {
    return frame.depth_m[static_cast<std::size_t>(row * kSide + kSide / 2)];
  };
  const double pixel = 2 * std::tan(0.5) / kSide;
  for (int row = 0; row < kSide; row += 4) {
    // Where a ray of slope t meets the cone, or the sea beyond its foot.
    const double t = std::abs(row - kSide / 2) * pixel;
    const double down_to_cone = (kAltitude - kTip) / (1 - kSlope * t);
    const double down = std::min(down_to_cone, kAltitude);
    EXPECT_NEAR(depth(row), down * std::hypot(1, t), 130) << row;
  }
}

// Heights count from the sea's level, also where the ground of the planet lies lower.
TEST_F(RegionalFrame, ABasinOfThePlanetMovesNoRegion) {
  const DemFile dem = {40, 40, {6.9, 0.005, 0, 46.1, 0, -0.005}};
  Scene scene = scene_of({write("basin.tif", dem, [](double, double) { return -1000.0; })});
  scene.height_map = directory_ / "flat.pgm";
  std::ofstream map(scene.height_map);
  map << "P2\n16 8\n255\n";
  for (int i = 0; i < 16 * 8; ++i) map << (i == 0 ? 255 : 0) << "\n";
  map.close();
  scene.lowest_m = -3000;
  scene.highest_m = 1000;
  scene.water_level_m = -4000;
  ASSERT_EQ(basin_depth_m(scene), 3000);
  Renderer renderer(scene);
  const AtmosphereTables& tables = small_tables();
  renderer.set_ground(lowered_by(basin_depth_m(scene), earth_clear().atmosphere), tables.color);
  const auto height = [&](double latitude) {
    return renderer.ground_height_m(Site{latitude * kDegree, 7 * kDegree, 0});
  };
  constexpr double kRough = 0.5;  // of flat land, at waves of 9 m
  EXPECT_NEAR(height(46), -1000, kRough);
  EXPECT_NEAR(height(10), -3000, kRough);
}

}  // namespace
}  // namespace skyfit
