// SPDX-License-Identifier: Apache-2.0
// A map of all directions is read as the sky that it shows: its axes lie where skyfit sky-map puts
// them, its bins hold the mean luminance.
#include "data_refs/sphere_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "complaint.h"
#include "data_refs/sky_image.h"
#include "model/geometry/map_projection.h"

namespace skyfit::refs {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

ImportOptions facts() {
  ImportOptions result;
  result.unit = "cd/m^2";
  result.sun_zenith_deg = 40;
  result.sun_azimuth_deg = 120;
  result.bin_deg = 12;
  return result;
}

std::string complaint(const ImportOptions& options) {
  const Image square{24, 24, {"Y"}, std::vector<float>(24 * 24, 1.0f)};
  return complaint_of([&] { sky_image_reference(square, nullptr, false, "sky.exr", options); });
}

// Where a pixel of a map looks: in degrees of zenith angle and of azimuth; below the horizon there
// is no sky. The axes are those of a light probe that looks north and of OpenGL's faces with x east
// and y up.
TEST(SphereMap, HasItsAxes) {
  ImportOptions options = facts();
  options.projection = "angular";
  const auto expect = [&](int width, double x, double y, double zenith_deg, double azimuth_deg) {
    const auto view = image_directions(options, width, 120, "sky.exr")->view(x, y);
    ASSERT_TRUE(view.has_value());
    EXPECT_NEAR(view->zenith / kDegree, zenith_deg, 1e-6);
    EXPECT_NEAR(std::remainder(view->azimuth / kDegree - azimuth_deg, 360), 0, 1e-6);
  };
  EXPECT_NEAR(image_directions(options, 120, 120, "sky.exr")->view(60, 30)->zenith, 0, 1e-6);
  expect(120, 60, 45, 45, 0);
  expect(120, 60, 15, 45, 180);
  const double diagonal = 30 * std::sqrt(0.5);
  expect(120, 60 + diagonal, 60 - diagonal, 45, 90);
  EXPECT_FALSE(image_directions(options, 120, 120, "sky.exr")->view(60, 61).has_value());
  EXPECT_FALSE(image_directions(options, 120, 120, "sky.exr")->view(1, 1).has_value());
  options.north_deg = 20;
  expect(120, 60, 45, 45, -20);
  options.east = "left";
  expect(120, 60 + diagonal, 60 - diagonal, 45, -70);
  options = facts();
  options.projection = "cube";
  expect(720, 60, 30, std::atan(2) / kDegree, 90);
  expect(720, 180, 30, std::atan(2) / kDegree, -90);
  expect(720, 300 + 30, 60, std::atan(0.5) / kDegree, 90);
  expect(720, 300, 120, 45, 180);
  expect(720, 540, 30, std::atan(2) / kDegree, 180);
  expect(720, 660, 30, std::atan(2) / kDegree, 0);
}

TEST(SphereMap, ShowsTheSky) {
  constexpr double kCurvature = 0.01;
  for (const auto& [projection, side] :
       {std::pair{"angular", 360}, {"cube", 120}, {"octahedral", 240}}) {
    ImportOptions options = facts();
    options.projection = projection;
    const auto map = make_map_projection(projection, side);
    Image image{map->width(), map->height(), {"R", "G", "B"}, {}};
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const Axis d = map->direction(x + 0.5, y + 0.5).value_or(Axis{0, 0, -1});
        const double value = d[2] > 0 ? 1000 * (2 + d[2] + d[0]) : 1e5;
        image.pixels.insert(image.pixels.end(), 3, static_cast<float>(value));
      }
    }
    const Reference sky = sky_image_reference(image, nullptr, false, "sky.exr", options);
    ASSERT_EQ(sky.samples.size(), 145u);
    for (const Sample& sample : sky.samples) {
      const double azimuth = sample.relative_azimuth + 120 * kDegree;
      EXPECT_NEAR(sample.value / (1000 * (2 + std::cos(sample.view_zenith) +
                                          std::sin(sample.view_zenith) * std::sin(azimuth))),
                  1, kCurvature)
          << projection;
    }
  }
}

TEST(SphereMap, IsRefusedInAnotherShapeAndBesideALens) {
  ImportOptions options = facts();
  options.projection = "cube";
  EXPECT_EQ(complaint(options),
            "sky.exr: 24 x 24 pixels: expected 144 x 24 of a map with projection = cube");
  options.projection = "angular";
  options.centre_y_px = 100;
  EXPECT_EQ(
      complaint(options),
      "sky.exr: centre_y_px: expected with a fisheye or a panorama, got projection = angular");
}

}  // namespace
}  // namespace skyfit::refs
