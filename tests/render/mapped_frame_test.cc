// SPDX-License-Identifier: Apache-2.0
// Frames of all directions show in each direction what a frame in perspective shows there, keep the
// light of the sun's disc, and have no light where they show nothing.
#include "render/sky_map/mapped_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "model/tables/table_lookup.h"
#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr double kSunZenith = 50 * kDegree, kAltitude_m = 400;

constexpr PictureProjection kProjections[] = {
    PictureProjection::kEquirectangular, PictureProjection::kFisheye, PictureProjection::kCube,
    PictureProjection::kOctahedral, PictureProjection::kAngular};

FrameOptions mapped(PictureProjection projection, int size) {
  FrameOptions options = options_at({kAltitude_m, 80 * kDegree, 0.7, 1}, kSunZenith, size, size);
  options.projection = projection;
  options.width = entry_of(projection).make(size, 1)->width();
  return options;
}

// As MapProjection takes them, in a picture whose camera looks toward an azimuth.
Axis axis_of(const glm::dvec3& ray, double azimuth) {
  const double c = std::cos(azimuth), s = std::sin(azimuth);
  return {-s * ray.x - c * ray.y, c * ray.x - s * ray.y, ray.z};
}

TEST(MappedFrame, HasTheNamesOfTheProjections) {
  for (std::size_t i = 0; i < std::size(kProjections); ++i)
    EXPECT_EQ(&entry_of(kProjections[i]), &map_projections()[i]);
  EXPECT_EQ(std::size(kProjections), map_projections().size());
}

TEST(MappedFrame, OfACubeHasThePixelsOfItsFaces) {
  constexpr int kSide = 256;
  const FrameOptions options = mapped(PictureProjection::kCube, kSide);
  const Frame cube = renderer().draw(options);
  const auto map = projection_of(options);
  int compared = 0;
  for (FrameOptions face : cube_faces(options)) {
    ASSERT_EQ(face.width, kSide);
    const Frame flat = renderer().draw(face);
    for (std::size_t i = 0; i < flat.luminance.size(); ++i) {
      const auto point = map->point(axis_of(ray_of(flat, i), options.camera.azimuth)).value();
      const std::size_t pixel =
          static_cast<std::size_t>(point[1]) * cube.width + static_cast<std::size_t>(point[0]);
      ++compared;
      ASSERT_LT(glm::length(ray_of(flat, i) - ray_of(cube, pixel)), 1e-5);
      ASSERT_EQ(flat.depth_m[i], cube.depth_m[pixel]);
      ASSERT_NEAR(cube.luminance[pixel], flat.luminance[i], 1e-4F * flat.luminance[i]);
    }
  }
  EXPECT_EQ(compared, cube.width * cube.height);
}

TEST(MappedFrame, ShowsInEachDirectionWhatAPerspectiveShows) {
  Camera camera{kAltitude_m, 70 * kDegree, -0.4, 50 * kDegree};
  const Frame flat = renderer().draw(options_at(camera, kSunZenith, 64, 64));
  for (const PictureProjection projection : kProjections) {
    const FrameOptions options = mapped(projection, 512);
    const Frame frame = renderer().draw(options);
    const auto map = projection_of(options);
    const double pitch =
        has_direction(projection) ? std::numbers::pi / 2 - options.camera.view_zenith : 0;
    WorstPixel worst;
    for (std::size_t i = 0; i < flat.luminance.size(); ++i) {
      const Axis d = axis_of(ray_of(flat, i), options.camera.azimuth);
      const auto point = map->point({d[0], std::cos(pitch) * d[1] + std::sin(pitch) * d[2],
                                     std::cos(pitch) * d[2] - std::sin(pitch) * d[1]});
      if (!point) continue;
      const std::size_t pixel = static_cast<std::size_t>((*point)[1]) * frame.width +
                                static_cast<std::size_t>((*point)[0]);
      // 512 pixels are as wide as 0.7 degrees at most.
      ASSERT_LT(glm::length(ray_of(flat, i) - ray_of(frame, pixel)), 0.013);
      const bool is_sun = glm::length(ray_of(flat, i) - direction_to(kSunZenith, 0)) < 0.05;
      if (is_sky(flat, i) && is_sky(frame, pixel) && !is_sun)
        worst.add(frame, pixel, frame.luminance[pixel] / flat.luminance[i] - 1);
    }
    worst.print(std::string(entry_of(projection).name).c_str());
    EXPECT_GT(worst.count(), 1000);
    EXPECT_LT(worst.rms(), 0.02) << entry_of(projection).name;
    EXPECT_LT(worst.error(), 0.1) << entry_of(projection).name;
  }
}

TEST(MappedFrame, DoesNotShowWhereFacesMeet) {
  FrameOptions options = mapped(PictureProjection::kEquirectangular, 128);
  options.samples_per_side = 2;
  options.shadows = true;
  options.clouds = {{.altitude_m = 3000, .cover = 0.4}};
  const Frame straight = renderer().draw(options);
  options.camera.azimuth += std::numbers::pi / 4;  // 32 columns
  const Frame turned = renderer().draw(options);
  double difference = 0, light = 0;
  for (int y = 0; y < straight.height; ++y) {
    for (int x = 0; x < straight.width; ++x) {
      const std::size_t row = static_cast<std::size_t>(y) * straight.width;
      const double a = straight.luminance[row + static_cast<std::size_t>((x + 32) % 256)],
                   b = turned.luminance[row + static_cast<std::size_t>(x)];
      if (std::abs(a - b) > 1e7) continue;  // the sun's disc
      difference += std::abs(a - b);
      light += a;
    }
  }
  EXPECT_LT(difference / light, 0.02);
}

TEST(MappedFrame, KeepsTheIlluminanceOfTheSunsDisc) {
  const NodeValues tau = lookup_optical_depth(small_tables(), kAltitude_m, std::cos(kSunZenith));
  double expected = 0;
  for (std::size_t k = 0; k < 4; ++k)
    expected += small_tables().color.xyz_from_nodes[1][k] * std::exp(-tau[k]);
  for (const PictureProjection projection : kProjections) {
    for (const int size : {24, 200, 1000}) {  // pixels of 8 to 0.2 degrees
      const FrameOptions options = mapped(projection, size);
      const Frame frame = renderer().draw(options);
      const auto map = projection_of(options);
      double illuminance = 0, cover = 0;
      for (const DiscPixel& disc : frame.discs) {
        const double solid_angle = map->solid_angle_sr(static_cast<int>(disc.pixel) % frame.width,
                                                       static_cast<int>(disc.pixel) / frame.width);
        EXPECT_NEAR(disc.solid_angle_sr, solid_angle, 1e-5 * solid_angle);
        EXPECT_LE(disc.luminance, frame.luminance[disc.pixel]);
        illuminance += disc.luminance * solid_angle;
        cover = std::max(cover, double{disc.cover});
      }
      EXPECT_NEAR(illuminance / expected, 1, 0.01) << entry_of(projection).name << ", " << size;
      EXPECT_LE(cover, 1);
    }
  }
}

TEST(MappedFrame, IsTiltedOnlyAsAngular) {
  for (const PictureProjection projection : kProjections) {
    FrameOptions options = mapped(projection, 65);
    options.camera.view_zenith = 70 * kDegree;
    const Frame frame = renderer().draw(options);
    if (projection == PictureProjection::kCube) continue;  // its middle is an edge
    const std::size_t middle = static_cast<std::size_t>(32) * frame.width + frame.width / 2;
    const double zenith = projection == PictureProjection::kAngular           ? 70
                          : projection == PictureProjection::kEquirectangular ? 90
                                                                              : 0;
    EXPECT_NEAR(frame.view_zenith_deg[middle], zenith, 1e-3) << entry_of(projection).name;
  }
}

TEST(MappedFrame, IsBlackWhereItShowsNothing) {
  FrameOptions options = mapped(PictureProjection::kFisheye, 40);
  options.samples_per_side = 2;  // of a pixel on the rim some show a direction
  options.field_of_view = 100 * kDegree;
  options.layers = true;
  options.glare = Glare::kEye;
  const Frame frame = renderer().draw(options);
  int outside = 0;
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 40; ++x) {
      const std::size_t pixel = static_cast<std::size_t>(y) * 40 + static_cast<std::size_t>(x);
      const double radius = std::hypot(x - 19.5, y - 19.5);
      if (radius < 19.9) {
        EXPECT_NEAR(frame.view_zenith_deg[pixel], radius / 20 * 50, 1e-3);
        EXPECT_GT(frame.luminance[pixel], 0);
      } else {
        EXPECT_EQ(std::isnan(frame.view_zenith_deg[pixel]), radius > 20);
      }
      if (std::isnan(frame.view_zenith_deg[pixel])) {
        ++outside;
        EXPECT_TRUE(std::isnan(frame.view_azimuth_deg[pixel]));
        EXPECT_EQ(frame.luminance[pixel], 0);
        for (std::size_t k = 3 * pixel; k < 3 * pixel + 3; ++k) {
          EXPECT_EQ(frame.rgb[k], 0);
          EXPECT_EQ(frame.layers->transmittance[k], 0);
          EXPECT_TRUE(frame.glare.empty() || frame.glare[k] == 0);
        }
      }
    }
  }
  EXPECT_NEAR(outside, 1600 * (1 - std::numbers::pi / 4), 60);
}

TEST(MappedFrame, RefusesSizesAndFieldsOfViewThatAProjectionHasNot) {
  const auto refused = [](FrameOptions options, auto change, const char* text) {
    change(options);
    EXPECT_THAT([&] { validate(options); }, ThrowsMessage<std::invalid_argument>(HasSubstr(text)));
  };
  const FrameOptions fisheye = mapped(PictureProjection::kFisheye, 64);
  EXPECT_NO_THROW(validate(fisheye));
  refused(
      fisheye, [](FrameOptions& options) { options.width = 65; },
      "render.size = 65 x 64: must be 1:1 for the projection fisheye");
  refused(
      mapped(PictureProjection::kCube, 64), [](FrameOptions& options) { options.width = 64; },
      "must be 6:1 for the projection cube");
  refused(
      fisheye, [](FrameOptions& options) { options.field_of_view = 7; },
      "render.field_of_view = 7: must be 1 to 360 degrees");
  refused(
      fisheye, [](FrameOptions& options) { options.terrain.eye = options.camera; },
      "must be perspective with a terrain.eye");
  EXPECT_THAT([&] { renderer().submit(fisheye); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("must be perspective on a device")));
}

}  // namespace
}  // namespace skyfit
