// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "cli/arguments.h"
#include "cli/feature_options.h"
#include "cli/render_arguments.h"
#include "cli/table_options.h"
#include "data_refs/civil_time.h"
#include "data_refs/solar_position.h"

namespace skyfit::cli {
namespace {

constexpr double kSequenceSeconds =
    10;  // of a sequence over a day, unless an option says otherwise

void parse_camera_place(const RenderOptions& options, const CLI::App& command, CameraPose& pose) {
  if (command.count("--latitude-deg") > 0) {
    pose.place = Place{parse_angle("--latitude-deg", options.latitude, -90, 90),
                       parse_angle("--longitude-deg", options.longitude, -360, 360)};
    pose.above_ground = true;
  }
  if (command.count("--dem") > 0) pose.above_ground = true;
  if (command.count("--altitude-m") > 0) {
    pose.altitude_m =
        parse_number_within("--altitude-m", options.altitude, 1, 1e9, "a height in metres");
    pose.above_ground = false;
  }
  if (command.count("--above-ground-m") > 0) {
    pose.altitude_m = parse_number_within("--above-ground-m", options.above_ground, 0.1, 1e9,
                                          "a height in metres");
    pose.above_ground = true;
  }
}

// Throws where an option makes sense at a place only.
void require_place(const CameraPose& pose, const CLI::App& command, const std::string& option) {
  if (command.count(option) > 0 && !pose.place)
    throw UsageError(option, command.get_option(option)->as<std::string>(),
                     "expected with --latitude-deg and --longitude-deg");
}

CameraPose parse_camera(const RenderOptions& options, const CLI::App& command,
                        const NamedView& view, double bottom_radius_m) {
  const auto given = [&](const char* option) { return command.count(option) > 0; };
  const bool is_flat = frame_with_features(command).projection == PictureProjection::kPerspective;
  CameraPose pose = pose_of(view, bottom_radius_m);
  parse_camera_place(options, command, pose);
  for (const char* option : {"--heading-deg", "--look-at", "--sun-azimuth-deg", "--date"})
    require_place(pose, command, option);
  if (given("--azimuth-deg"))
    pose.azimuth = parse_angle("--azimuth-deg", options.azimuth, -360, 360);
  if (given("--heading-deg")) {
    pose.azimuth = parse_angle("--heading-deg", options.heading, -360, 360);
    pose.from_north = true;
  }
  if (given("--view-zenith-deg"))
    pose.view_zenith = parse_angle("--view-zenith-deg", options.view_zenith, 0, 180);
  if (given("--pitch-deg"))
    pose.view_zenith = radians(90) - parse_angle("--pitch-deg", options.pitch, -90, 90);
  if (given("--look-at")) {
    const auto values = parse_tuple("--look-at", options.look_at, 3, 3,
                                    "LATITUDE,LONGITUDE,ALTITUDE in degrees and metres");
    if (!(values[2] >= 0 && values[2] <= 1e9))
      throw UsageError("--look-at", options.look_at, "expected an altitude from 0 to 1e9 m");
    pose.look_at = Target{parse_place("--look-at", options.look_at, values), values[2]};
  }
  if (given("--field-of-view-deg") && is_flat)
    pose.vertical_fov = parse_angle("--field-of-view-deg", options.field_of_view, 1, 150);
  if (given("--overview-m"))
    pose.overview_m =
        parse_number_within("--overview-m", options.overview, 1, 1e9, "a height in metres");
  validate(pose);
  return pose;
}

Instant parse_time(const RenderOptions& options, const std::string& clock) {
  const double offset = parse_number_within("--utc-offset-h", options.utc_offset, -14, 14, "hours");
  if (const auto time = parse_instant(options.date, clock, offset)) return *time;
  if (!parse_instant(options.date, "00:00", 0))
    throw UsageError("--date", options.date, "expected a day YYYY-MM-DD");
  throw UsageError("--time", options.time, "expected HH:MM or HH:MM..HH:MM");
}

std::string first_clock(const std::string& time) { return time.substr(0, time.find("..")); }

// How many frames from one time to another, and the time between them.
struct Pace {
  int frames;
  double step_min;
};
Pace pace_of(const RenderOptions& options, const CLI::App& command, double length_min,
             double frames_per_second) {
  if (command.count("--frames") > 0) {
    if (options.frames < 1 || options.frames > kMaxSequenceFrames)
      throw UsageError("--frames", fmt::to_string(options.frames),
                       fmt::format("expected 1 to {}", kMaxSequenceFrames));
    return {options.frames, options.frames > 1 ? length_min / (options.frames - 1) : 0};
  }
  if (command.count("--step-min") == 0) {
    const int frames = std::clamp(
        static_cast<int>(std::lround(kSequenceSeconds * frames_per_second)), 2, kMaxSequenceFrames);
    return {frames, length_min / (frames - 1)};
  }
  const double step = parse_number("--step-min", options.step_min);
  if (!(step > 0 && length_min / step < kMaxSequenceFrames))
    throw UsageError(
        "--step-min", options.step_min,
        fmt::format("expected minutes > 0 that make at most {} frames", kMaxSequenceFrames));
  return {static_cast<int>(std::floor(length_min / step + 1e-9)) + 1, step};
}

}  // namespace

Place parse_place(std::string_view option, const std::string& text,
                  const std::vector<double>& values) {
  if (std::abs(values[0]) <= 90 && std::abs(values[1]) <= 360)
    return {radians(values[0]), radians(values[1])};
  throw UsageError(option, text,
                   "expected a latitude from -90 to 90 and a longitude from -360 to 360 degrees");
}

std::optional<Instant> parse_instant(const std::string& date, const std::string& clock,
                                     double utc_offset_h) {
  return refs::instant(date, clock, utc_offset_h);
}

SunDirection sun_over(Instant time, const Place& place) {
  const refs::SolarPosition sun = refs::solar_position(time, {place.latitude, place.longitude, 0});
  return {sun.zenith, sun.azimuth};
}

Keyframe parse_start(const RenderOptions& options, const CLI::App& command) {
  const NamedView& view = entry_named("--view", options.view, named_views());
  Keyframe start;
  start.sun.direction = sun_of(view);
  if (command.count("--sun-zenith-deg") > 0)
    start.sun.direction.zenith = parse_angle("--sun-zenith-deg", options.sun_zenith, 0, 180);
  if (command.count("--sun-azimuth-deg") > 0)
    start.sun.direction.azimuth = parse_angle("--sun-azimuth-deg", options.sun_azimuth, -360, 360);
  if (command.count("--time") > 0) start.sun.time = parse_time(options, first_clock(options.time));
  if (options.start) {
    start.preset = *options.start;
  } else if (command.count("--preset") > 0) {
    start.preset = preset_named(options.preset);
  }
  start.camera = parse_camera(options, command, view, start.preset.atmosphere.bottom_radius_m);
  return start;
}

Sequence parse_day(const RenderOptions& options, const CLI::App& command, Keyframe start) {
  using Minutes = std::chrono::duration<double, std::ratio<60>>;
  const std::string last = parse_ends("--time", options.time, "HH:MM..HH:MM").second;
  Instant end = parse_time(options, last);
  if (end <= *start.sun.time) end += std::chrono::days(1);
  Sequence sequence;
  sequence.frames_per_second = parse_number_within("--frames-per-second", options.frames_per_second,
                                                   0.001, 1000, "a number");
  const Pace pace =
      pace_of(options, command, Minutes(end - *start.sun.time).count(), sequence.frames_per_second);
  if (command.count("--azimuth-deg") == 0 && !start.camera.from_north) {
    start.camera.azimuth += sun_over(*start.sun.time, *start.camera.place).azimuth;
    start.camera.from_north = true;
  }
  sequence.frames = pace.frames;
  sequence.keyframes = {start};
  if (pace.frames > 1) {
    Keyframe stop = start;
    stop.time_s = sequence.time_s(pace.frames - 1);
    *stop.sun.time +=
        std::chrono::round<std::chrono::milliseconds>(Minutes(pace.step_min * (pace.frames - 1)));
    sequence.keyframes.push_back(stop);
  }
  return sequence;
}

}  // namespace skyfit::cli
