// SPDX-License-Identifier: Apache-2.0
// Cameras at places: what a point on a sphere is seen at, against closed forms, and what lies
// between two cameras.
#include "render/scene/placement.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace skyfit {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180;
constexpr double kRadius = 6360e3;
constexpr double kRounding = 1e-12;  // radians
constexpr double kMetres = 1e-6;     // of rounding, at the planet's size

double flat(const std::optional<Site>&) { return 0; }

TEST(Sight, OfPointsAboveAndBelow) {
  const Place place = {0.7, -1.2};
  const Sight up = sight_of({place, 5000}, {place, 2}, kRadius),
              down = sight_of({place, 0}, {place, 400e3}, kRadius);
  EXPECT_NEAR(up.zenith, 0, kRounding);
  EXPECT_NEAR(up.distance_m, 4998, kMetres);
  EXPECT_NEAR(down.zenith, kPi, kRounding);
  EXPECT_NEAR(down.distance_m, 400e3, kMetres);
}

// Two points of one height, an arc apart: the chord dips half the arc below the horizontal.
TEST(Sight, OfAPointOfTheSameHeightIsTheChord) {
  const double height = 1200, arc = 0.3;
  const Sight east = sight_of({{0, 0.5 + arc}, height}, {{0, 0.5}, height}, kRadius);
  EXPECT_NEAR(east.zenith, kPi / 2 + arc / 2, kRounding);
  EXPECT_NEAR(east.azimuth, kPi / 2, kRounding);
  EXPECT_NEAR(east.distance_m, 2 * (kRadius + height) * std::sin(arc / 2), kMetres);
  const Sight south = sight_of({{0.6 - arc, 2}, height}, {{0.6, 2}, height}, kRadius);
  EXPECT_NEAR(south.zenith, kPi / 2 + arc / 2, kRounding);
  EXPECT_NEAR(std::abs(south.azimuth), kPi, kRounding);
}

// The horizon of a camera at height h is arccos(R / (R + h)) away and as much below the horizontal.
TEST(Sight, OfTheHorizonIsItsDip) {
  const double height = 400e3, dip = std::acos(kRadius / (kRadius + height));
  const Sight horizon = sight_of({{dip, 0}, 0}, {{0, 0}, height}, kRadius);
  EXPECT_NEAR(horizon.zenith, kPi / 2 + dip, kRounding);
  EXPECT_NEAR(horizon.azimuth, 0, kRounding);
  EXPECT_NEAR(horizon.distance_m, (kRadius + height) * std::sin(dip), kMetres);
}

// The horizon, arccos(R / (R + h)) below the horizontal, lies in the picture, a twentieth of its
// height from the edge; of space that is the full disc, which is a third of the picture's height or
// more.
TEST(NamedViews, HaveTheLimbInThePictureOnEveryPlanet) {
  constexpr double kSmallestDisc = 1.0 / 3;
  for (const NamedView& view : named_views()) {
    for (const double radius_km : {200., 400., 1000., 1737., 2499., 2501., 2575., 3389.5, 6052.,
                                   6378., 6401., 12000., 25000., 70000.}) {
      const double radius = 1000 * radius_km;
      const CameraPose pose = pose_of(view, radius);
      const double horizon = kPi / 2 + std::acos(radius / (radius + pose.altitude_m));
      EXPECT_LT(std::abs(horizon - pose.view_zenith), 0.45 * pose.vertical_fov)
          << view.name << " " << radius_km;
      if (view.name == "space") {
        EXPECT_GT(2 * (kPi - horizon), kSmallestDisc * pose.vertical_fov) << radius_km;
      }
    }
  }
}

TEST(NamedViews, HaveTheirOwnHeightsFromTitanToTheEarth) {
  for (const NamedView& view : named_views()) {
    for (const double radius : {2575e3, 3389.5e3, 6360e3, 6378.137e3})
      EXPECT_EQ(pose_of(view, radius).altitude_m, view.camera.altitude_m) << view.name;
  }
  EXPECT_DOUBLE_EQ(pose_of(find_view("limb"), 400e3).altitude_m, 64e3);
  EXPECT_DOUBLE_EQ(pose_of(find_view("space"), 64e6).altitude_m, 110e6);
  EXPECT_EQ(pose_of(find_view("10km"), 400e3).altitude_m, 10e3);
}

// The initial course of navigation.
TEST(Sight, AzimuthIsTheCourseOfTheGreatCircle) {
  const Place from = {47 * kDegree, 8 * kDegree}, to = {40.7 * kDegree, -74 * kDegree};
  const double across = to.longitude - from.longitude;
  const double course =
      std::atan2(std::sin(across) * std::cos(to.latitude),
                 std::cos(from.latitude) * std::sin(to.latitude) -
                     std::sin(from.latitude) * std::cos(to.latitude) * std::cos(across));
  EXPECT_NEAR(sight_of({to, 0}, {from, 300}, kRadius).azimuth, course, kRounding);
}

TEST(Sight, OfWhatStandsBesideTheCameraKeepsItsDigits) {
  const Place camera = {47 * kDegree, 8 * kDegree};
  const double step = 1 / kRadius;  // one metre to the north
  const Sight near =
      sight_of({{camera.latitude + step, camera.longitude}, 0}, {camera, 1}, kRadius);
  EXPECT_NEAR(near.zenith, 135 * kDegree, 1e-7);
  EXPECT_NEAR(near.distance_m, std::numbers::sqrt2, 1e-7);
}

TEST(PlaceCamera, HeadingsBecomeAzimuthsFromTheSun) {
  CameraPose pose;
  pose.place = Place{0.8, 0.1};
  pose.azimuth = 90 * kDegree;
  pose.from_north = true;
  FrameOptions frame;
  place_camera(pose, {30 * kDegree, 200 * kDegree}, kRadius, flat, frame);
  EXPECT_NEAR(frame.camera.azimuth, -110 * kDegree, kRounding);
  EXPECT_EQ(frame.sun_zenith, 30 * kDegree);
  ASSERT_TRUE(frame.site);
  EXPECT_EQ(frame.site->latitude, 0.8);
  EXPECT_EQ(frame.site->sun_azimuth, 200 * kDegree);
}

TEST(PlaceCamera, HeightsCountFromTheGroundWhereTheySaySo) {
  CameraPose pose;
  pose.altitude_m = 10;
  pose.above_ground = true;
  FrameOptions frame;
  place_camera(
      pose, {}, kRadius, [](const std::optional<Site>&) { return 1500.0; }, frame);
  EXPECT_EQ(frame.camera.altitude_m, 1510);
}

TEST(PlaceCamera, LooksAtAPoint) {
  CameraPose pose;
  pose.place = Place{0, 0};
  pose.altitude_m = 1000;
  pose.look_at = Target{{0, 0.01}, 1000};
  FrameOptions frame;
  place_camera(pose, {1, 30 * kDegree}, kRadius, flat, frame);
  EXPECT_NEAR(frame.camera.view_zenith, kPi / 2 + 0.005, kRounding);
  EXPECT_NEAR(frame.camera.azimuth, 60 * kDegree, kRounding);
  pose.look_at = Target{{0, 0}, 1000};
  EXPECT_THAT([&] { place_camera(pose, {}, kRadius, flat, frame); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("camera.look_at")));
}

// The camera that was meant becomes the eye whose blocks are shown, and the next frame has none.
TEST(PlaceCamera, AnOverviewIsTakenFromAboveTheCamera) {
  CameraPose pose;
  pose.altitude_m = 2000;
  pose.view_zenith = 95 * kDegree;
  pose.overview_m = 5e5;
  FrameOptions frame;
  const auto flat = [](const std::optional<Site>&) { return 0.0; };
  place_camera(pose, {1, 0}, kRadius, flat, frame);
  ASSERT_TRUE(frame.terrain.eye);
  EXPECT_EQ(frame.terrain.eye->altitude_m, 2000);
  EXPECT_EQ(frame.terrain.eye->view_zenith, 95 * kDegree);
  EXPECT_EQ(frame.camera.altitude_m, 502e3);
  EXPECT_NEAR(frame.camera.view_zenith, 180 * kDegree, kRounding);
  EXPECT_EQ(frame.camera.azimuth, frame.terrain.eye->azimuth);
  pose.overview_m = 0;
  place_camera(pose, {1, 0}, kRadius, flat, frame);
  EXPECT_FALSE(frame.terrain.eye);
  EXPECT_EQ(frame.camera.altitude_m, 2000);
}

TEST(Between, AnglesGoTheShortWay) {
  EXPECT_NEAR(angle_between(350 * kDegree, 10 * kDegree, 0.5), 360 * kDegree, kRounding);
  EXPECT_NEAR(angle_between(10 * kDegree, 350 * kDegree, 0.25), 5 * kDegree, kRounding);
}

TEST(Between, AltitudesGrowByTheSameFactor) {
  EXPECT_NEAR(altitude_between(10, 1000, 0.5), 100, 1e-9);
  EXPECT_NEAR(altitude_between(2, 400e3, 1), 400e3, 1e-6);
}

TEST(Between, PlacesFollowTheGreatCircle) {
  const Place pole =
      place_between({80 * kDegree, 0}, {80 * kDegree, 180 * kDegree}, 0.5);  // over the pole
  EXPECT_NEAR(pole.latitude, 90 * kDegree, 1e-9);
  const Place equator = place_between({0, 170 * kDegree}, {0, -170 * kDegree}, 0.75);
  EXPECT_NEAR(equator.longitude, -175 * kDegree, kRounding);
}

TEST(Between, CamerasOfTwoKindsHaveNothing) {
  CameraPose a, b;
  a.place = Place{};
  EXPECT_THAT([&] { pose_between(a, b, 0.5); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("latitude_deg and longitude_deg")));
  b.place = Place{};
  b.from_north = true;
  EXPECT_THAT([&] { pose_between(a, b, 0.5); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("heading_deg")));
}

}  // namespace
}  // namespace skyfit
