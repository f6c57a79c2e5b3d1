// SPDX-License-Identifier: Apache-2.0
#include "render/scene/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include "model/numerics/angles.h"

namespace skyfit {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// From the planet's centre, the third axis through the north pole.
Vector direction_of(const Place& place) {
  return {std::cos(place.latitude) * std::cos(place.longitude),
          std::cos(place.latitude) * std::sin(place.longitude), std::sin(place.latitude)};
}

Place place_of(const Vector& direction) {
  return {std::atan2(direction[2], std::hypot(direction[0], direction[1])),
          std::atan2(direction[1], direction[0])};
}

void require(bool good, std::string_view field, double value, std::string_view expected) {
  if (!good)
    throw std::invalid_argument(
        fmt::format("camera.{} = {:.9g}: must be {}", field, value, expected));
}

void require_both(bool same, std::string_view field) {
  if (!same)
    throw std::invalid_argument(
        fmt::format("camera: {}: expected in all keyframes or in none", field));
}

void require_place(const Place& place, std::string_view prefix) {
  require(std::abs(place.latitude) <= kTurn / 4, fmt::format("{}latitude_deg", prefix),
          place.latitude * kDegreesPerRadian, "-90 to 90 degrees");
  require(std::abs(place.longitude) <= kTurn, fmt::format("{}longitude_deg", prefix),
          place.longitude * kDegreesPerRadian, "-360 to 360 degrees");
}

}  // namespace

Sight sight_of(const Target& target, const Target& from, double bottom_radius_m) {
  const double sin_lat = std::sin(from.place.latitude), cos_lat = std::cos(from.place.latitude),
               sin_lon = std::sin(from.place.longitude), cos_lon = std::cos(from.place.longitude);
  const Vector up = direction_of(from.place), east = {-sin_lon, cos_lon, 0},
               north = {-sin_lat * cos_lon, -sin_lat * sin_lon, cos_lat};
  const Vector there = direction_of(target.place);
  const Vector chord = {there[0] - up[0], there[1] - up[1], there[2] - up[2]};
  // From the chord: differences of the two points themselves would lose the digits of places that
  // are close. Upward, |chord|^2 / 2 = 1 - cos(arc).
  const double far = bottom_radius_m + target.altitude_m;
  const double x = far * dot(chord, east), y = far * dot(chord, north),
               rise = target.altitude_m - from.altitude_m - 0.5 * far * dot(chord, chord);
  return {std::atan2(std::hypot(x, y), rise), std::atan2(x, y), std::hypot(x, y, rise)};
}

CameraPose pose_of(const NamedView& view, double bottom_radius_m) {
  constexpr double kOutside_m = 1e5;  // of the air, on the Earth
  CameraPose pose;
  if (view.site) pose.place = Place{view.site->latitude, view.site->longitude};
  pose.altitude_m = view.camera.altitude_m;
  if (pose.altitude_m > kOutside_m)
    pose.altitude_m *=
        bottom_radius_m / std::clamp(bottom_radius_m, kSmallestLikeEarth_m, kLargestLikeEarth_m);
  pose.above_ground = view.site.has_value();
  pose.view_zenith = view.camera.view_zenith;
  pose.azimuth = view.camera.azimuth;
  pose.vertical_fov = view.camera.vertical_fov;
  return pose;
}

SunDirection sun_of(const NamedView& view) {
  return {view.sun_zenith, view.site ? view.site->sun_azimuth : 0};
}

void validate(const CameraPose& pose) {
  require(pose.altitude_m >= (pose.above_ground ? 0.1 : 1) && pose.altitude_m <= 1e9,
          pose.above_ground ? "above_ground_m" : "altitude_m", pose.altitude_m,
          pose.above_ground ? "0.1 to 1e9 m" : "1 to 1e9 m");
  require(pose.view_zenith >= 0 && pose.view_zenith <= kTurn / 2, "view_zenith_deg",
          pose.view_zenith * kDegreesPerRadian, "0 to 180 degrees");
  require(std::isfinite(pose.azimuth), pose.from_north ? "heading_deg" : "azimuth_deg",
          pose.azimuth * kDegreesPerRadian, "finite");
  require(pose.vertical_fov >= kRadiansPerDegree && pose.vertical_fov <= 150 * kRadiansPerDegree,
          "field_of_view_deg", pose.vertical_fov * kDegreesPerRadian, "1 to 150 degrees");
  require(pose.overview_m >= 0 && pose.overview_m <= 1e9, "overview_m", pose.overview_m,
          "0 to 1e9 m");
  if (pose.place) require_place(*pose.place, "");
  if (!pose.place && (pose.from_north || pose.look_at))
    throw std::invalid_argument(
        fmt::format("camera: {}: expected with latitude_deg and longitude_deg",
                    pose.look_at ? "look_at" : "heading_deg"));
  if (pose.look_at) {
    require_place(pose.look_at->place, "look_at.");
    require(pose.look_at->altitude_m >= 0 && pose.look_at->altitude_m <= 1e9, "look_at.altitude_m",
            pose.look_at->altitude_m, "0 to 1e9 m");
  }
}

double angle_between(double a, double b, double share) {
  return a + share * std::remainder(b - a, kTurn);
}

double altitude_between(double a, double b, double share) { return a * std::pow(b / a, share); }

Place place_between(const Place& a, const Place& b, double share) {
  if (share <= 0) return a;
  if (share >= 1) return b;
  const Vector from = direction_of(a), to = direction_of(b);
  const Vector chord = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  const double arc = 2 * std::asin(std::min(0.5 * std::sqrt(dot(chord, chord)), 1.0));
  if (std::sin(arc) < 1e-12) return share < 0.5 ? a : b;  // the same place, or its antipode
  Vector between;
  for (std::size_t i = 0; i < 3; ++i)
    between[i] = std::sin((1 - share) * arc) * from[i] + std::sin(share * arc) * to[i];
  return place_of(between);
}

SunDirection sun_between(const SunDirection& a, const SunDirection& b, double share) {
  return {std::lerp(a.zenith, b.zenith, share), angle_between(a.azimuth, b.azimuth, share)};
}

void require_one_kind(const CameraPose& a, const CameraPose& b) {
  require_both(a.place.has_value() == b.place.has_value(), "latitude_deg and longitude_deg");
  require_both(a.above_ground == b.above_ground, "above_ground_m");
  require_both(a.look_at.has_value() == b.look_at.has_value(), "look_at");
  require_both(a.look_at || a.from_north == b.from_north, "heading_deg");
}

CameraPose pose_between(const CameraPose& a, const CameraPose& b, double share) {
  require_one_kind(a, b);
  CameraPose pose = a;
  if (a.place) pose.place = place_between(*a.place, *b.place, share);
  pose.altitude_m = altitude_between(a.altitude_m, b.altitude_m, share);
  pose.view_zenith = std::lerp(a.view_zenith, b.view_zenith, share);
  pose.azimuth = angle_between(a.azimuth, b.azimuth, share);
  pose.vertical_fov = std::lerp(a.vertical_fov, b.vertical_fov, share);
  if (a.look_at) {
    pose.look_at = Target{place_between(a.look_at->place, b.look_at->place, share),
                          std::lerp(a.look_at->altitude_m, b.look_at->altitude_m, share)};
  }
  return pose;
}

void place_camera(const CameraPose& pose, const SunDirection& sun, double bottom_radius_m,
                  const std::function<double(const std::optional<Site>&)>& ground_height_m,
                  FrameOptions& frame) {
  frame.sun_zenith = sun.zenith;
  frame.site.reset();
  if (pose.place) frame.site = Site{pose.place->latitude, pose.place->longitude, sun.azimuth};
  Camera& camera = frame.camera;
  camera.altitude_m = pose.altitude_m + (pose.above_ground ? ground_height_m(frame.site) : 0);
  camera.view_zenith = pose.view_zenith;
  camera.azimuth = pose.azimuth;
  camera.vertical_fov = pose.vertical_fov;
  if (pose.look_at) {
    const Sight sight =
        sight_of(*pose.look_at, {pose.place.value(), camera.altitude_m}, bottom_radius_m);
    if (!(sight.distance_m > 0))
      throw std::invalid_argument("camera.look_at: expected another point than the camera's own");
    camera.view_zenith = sight.zenith;
    camera.azimuth = sight.azimuth;
  }
  if (pose.from_north || pose.look_at)
    camera.azimuth = std::remainder(camera.azimuth - sun.azimuth, kTurn);
  frame.terrain.eye.reset();
  if (pose.overview_m > 0) {
    frame.terrain.eye = camera;
    camera.altitude_m += pose.overview_m;
    camera.view_zenith = kTurn / 2;
  }
}

}  // namespace skyfit
