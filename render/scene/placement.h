// SPDX-License-Identifier: Apache-2.0
// Where a camera stands and looks, as a person says it: a place on the planet, a height above the
// ground or above the bottom radius, a heading from north or an azimuth from the sun, or a point to
// look at. And what lies between two such cameras. Angles in radians, lengths in metres.
#pragma once

#include <functional>
#include <optional>

#include "render/render.h"

namespace skyfit {

struct Place {
  double latitude = 0, longitude = 0;
  bool operator==(const Place&) const = default;
};

struct Target {
  Place place;
  double altitude_m = 0;  // above the bottom radius
  bool operator==(const Target&) const = default;
};

// A point as seen from another, on a sphere and along a straight line.
struct Sight {
  double zenith = 0;
  double azimuth = 0;  // from north over east, -pi .. pi
  double distance_m = 0;
};
Sight sight_of(const Target& target, const Target& from, double bottom_radius_m);

struct SunDirection {
  double zenith = 0;
  double azimuth = 0;  // from north over east; of use at a place only
};

struct CameraPose {
  std::optional<Place> place;     // without one: a coast that every planet has
  double altitude_m = 2;          // above the bottom radius
  bool above_ground = false;      // above the ground instead
  double view_zenith = 1.4;       // of the picture's centre
  double azimuth = 0;             // of the picture's centre, from the sun's azimuth
  bool from_north = false;        // from north instead, at a place only
  std::optional<Target> look_at;  // instead of view_zenith and azimuth, at a place only
  double vertical_fov = 1;
  // 0, or the picture is taken from so far above the camera, straight down, and shows the blocks of
  // the ground that the camera sees.
  double overview_m = 0;
  bool operator==(const CameraPose&) const = default;
};

// Of a planet whose bottom radius is so long. Views from outside the air keep their heights for
// radii from kSmallestLikeEarth_m to kLargestLikeEarth_m; smaller and larger planets look as those
// two do: their heights are in proportion to the radius.
inline constexpr double kSmallestLikeEarth_m = 2.5e6, kLargestLikeEarth_m = 6.4e6;
CameraPose pose_of(const NamedView& view, double bottom_radius_m);
SunDirection sun_of(const NamedView& view);

// Throws std::invalid_argument `camera.field = value: must be ...` for what no ground could make
// good.
void validate(const CameraPose& pose);

// Share 0..1 of the way: angles the short way round, places along the great circle, altitudes by
// the same factor in the same time.
double angle_between(double a, double b, double share);
double altitude_between(double a, double b, double share);
Place place_between(const Place& a, const Place& b, double share);
SunDirection sun_between(const SunDirection& a, const SunDirection& b, double share);

// The two must be of one kind: throws std::invalid_argument `camera.field: expected ...` that names
// what only one of them has.
void require_one_kind(const CameraPose& a, const CameraPose& b);
CameraPose pose_between(const CameraPose& a, const CameraPose& b, double share);

// Camera, site and sun of a frame. `ground_height_m` is Renderer::ground_height_m(); asked only for
// a pose above ground. Throws std::invalid_argument where the point to look at is the camera.
void place_camera(const CameraPose& pose, const SunDirection& sun, double bottom_radius_m,
                  const std::function<double(const std::optional<Site>&)>& ground_height_m,
                  FrameOptions& frame);

}  // namespace skyfit
