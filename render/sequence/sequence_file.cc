// SPDX-License-Identifier: Apache-2.0
// Reading a sequence; see render/sequence/sequence.h for the format.
#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "model/atmosphere/parameters.h"
#include "model/base/preset_reader.h"
#include "model/numerics/angles.h"
#include "render/sequence/sequence.h"

namespace skyfit {
namespace {

constexpr int kSequenceVersion = 1;

double angle(const PresetReader& object, std::string_view field, double low, double high) {
  const double value = object.number(field);
  if (!(value >= low && value <= high))
    object.fail_value(field, fmt::format("an angle from {} to {} degrees", low, high));
  return value * kRadiansPerDegree;
}

double length(const PresetReader& object, std::string_view field, double low) {
  constexpr double kHighest = 1e9;
  const double value = object.number(field);
  if (!(value >= low && value <= kHighest))
    object.fail_value(field, fmt::format("a length from {} to {} m", low, kHighest));
  return value;
}

Place place(const PresetReader& object) {
  return {angle(object, "latitude_deg", -90, 90), angle(object, "longitude_deg", -360, 360)};
}

// Refuses a second field that says the same as the first.
bool has_one(const PresetReader& object, std::initializer_list<std::string_view> fields) {
  std::string_view found;
  for (const std::string_view field : fields) {
    if (!object.has(field)) continue;
    if (!found.empty()) object.fail_value(field, fmt::format("not beside {}", found));
    found = field;
  }
  return !found.empty();
}

void read_height(const PresetReader& object, CameraPose& pose) {
  if (!has_one(object, {"altitude_m", "above_ground_m"})) return;
  pose.above_ground = object.has("above_ground_m");
  pose.altitude_m =
      pose.above_ground ? length(object, "above_ground_m", 0.1) : length(object, "altitude_m", 1);
}

void read_direction(const PresetReader& object, CameraPose& pose) {
  const bool turns = has_one(object, {"azimuth_deg", "heading_deg", "look_at"});
  const bool tilts = has_one(object, {"view_zenith_deg", "pitch_deg", "look_at"});
  if (object.has("look_at")) {
    const PresetReader target = object.object("look_at");
    target.expect_only({"latitude_deg", "longitude_deg", "altitude_m"});
    pose.look_at = Target{place(target), length(target, "altitude_m", 0)};
    return;
  }
  if (turns || tilts) pose.look_at.reset();
  if (turns) {
    pose.from_north = object.has("heading_deg");
    pose.azimuth = angle(object, pose.from_north ? "heading_deg" : "azimuth_deg", -360, 360);
  }
  if (object.has("pitch_deg")) {
    pose.view_zenith = 90 * kRadiansPerDegree - angle(object, "pitch_deg", -90, 90);
  } else if (tilts) {
    pose.view_zenith = angle(object, "view_zenith_deg", 0, 180);
  }
}

CameraPose read_camera(const PresetReader& object, CameraPose pose, double bottom_radius_m) {
  object.expect_only({"view", "latitude_deg", "longitude_deg", "altitude_m", "above_ground_m",
                      "azimuth_deg", "heading_deg", "view_zenith_deg", "pitch_deg", "look_at",
                      "field_of_view_deg"});
  if (object.has("view")) {
    const std::string name = object.text("view");
    try {
      pose = pose_of(find_view(name), bottom_radius_m);
    } catch (const std::invalid_argument& error) {
      object.fail_value("view", error.what());
    }
  }
  if (object.has("latitude_deg") || object.has("longitude_deg")) pose.place = place(object);
  read_height(object, pose);
  read_direction(object, pose);
  if (object.has("field_of_view_deg"))
    pose.vertical_fov = angle(object, "field_of_view_deg", 1, 150);
  return pose;
}

// What the last date and offset were, for keyframes that name a time only.
struct Calendar {
  std::string date;
  double utc_offset_h = 0;
};

SunSetting read_sun(const PresetReader& object, const SequenceSources& sources, SunSetting sun,
                    Calendar& calendar) {
  object.expect_only({"zenith_deg", "azimuth_deg", "date", "time", "utc_offset_h"});
  if (!object.has("time")) {
    if (object.has("date")) object.text("time");  // is missing
    sun.time.reset();
    sun.direction.zenith = angle(object, "zenith_deg", 0, 180);
    if (object.has("azimuth_deg")) sun.direction.azimuth = angle(object, "azimuth_deg", -360, 360);
    return sun;
  }
  for (const std::string_view field : {"zenith_deg", "azimuth_deg"})
    if (object.has(field)) object.fail_value(field, "not beside time");
  if (object.has("date")) calendar.date = object.text("date");
  if (calendar.date.empty()) object.text("date");  // is missing
  if (object.has("utc_offset_h")) {
    calendar.utc_offset_h = object.number("utc_offset_h");
    if (!(std::abs(calendar.utc_offset_h) <= 14))
      object.fail_value("utc_offset_h", "hours from -14 to 14");
  }
  sun.time = sources.instant(calendar.date, object.text("time"), calendar.utc_offset_h);
  if (!sun.time)
    object.fail_value(
        "time",
        fmt::format("HH:MM or HH:MM:SS of a day YYYY-MM-DD, the day is \"{}\"", calendar.date));
  return sun;
}

Preset read_preset(const PresetReader& object, const SequenceSources& sources, Preset preset) {
  if (object.has("preset")) preset = sources.preset(object.text("preset"));
  if (preset.name.empty()) object.text("preset");  // is missing
  if (!object.has("parameters")) return preset;
  const PresetReader parameters = object.object("parameters");
  for (const auto& [name, value] : parameters.value().items()) {
    parameters.complaining([&] { return parameter_from_name(name); });
    const Parameter parameter = parameter_from_name(name);
    if (!has_parameter(preset.atmosphere, parameter))
      parameters.fail_value(name, fmt::format("a parameter that {} has", preset.name));
    set_parameter(preset.atmosphere, parameter, parameters.number(name));
  }
  object.complaining([&] {
    validate(preset.atmosphere);
    return 0;
  });
  preset.fit = nullptr;
  return preset;
}

Keyframe read_keyframe(const PresetReader& object, const Keyframe& before,
                       const SequenceSources& sources, Calendar& calendar) {
  object.expect_only({"time_s", "camera", "sun", "preset", "parameters"});
  Keyframe keyframe = before;
  keyframe.time_s = object.number("time_s");
  keyframe.preset = read_preset(object, sources, before.preset);
  if (object.has("camera"))
    keyframe.camera = read_camera(object.object("camera"), before.camera,
                                  keyframe.preset.atmosphere.bottom_radius_m);
  if (object.has("sun"))
    keyframe.sun = read_sun(object.object("sun"), sources, before.sun, calendar);
  object.complaining([&] {
    validate(keyframe.camera);
    return 0;
  });
  if (keyframe.sun.time && !keyframe.camera.place) {
    object.complaining([]() -> int {
      throw std::invalid_argument(
          "sun.time: expected a camera with latitude_deg and longitude_deg");
    });
  }
  return keyframe;
}

int frame_count(const PresetReader& root, const Sequence& sequence) {
  if (!root.has("frames")) {
    const double count =
        std::floor(sequence.keyframes.back().time_s * sequence.frames_per_second + 1e-6) + 1;
    if (!(count <= kMaxSequenceFrames))
      root.fail_value("keyframes", fmt::format("at most {} frames", kMaxSequenceFrames));
    return static_cast<int>(count);
  }
  const double count = root.number("frames");
  if (!(count >= 1 && count <= kMaxSequenceFrames) || count != std::floor(count))
    root.fail_value("frames", fmt::format("a whole number from 1 to {}", kMaxSequenceFrames));
  return static_cast<int>(count);
}

}  // namespace

Sequence parse_sequence(std::string_view text, std::string_view source, const Keyframe& start,
                        const SequenceSources& sources) {
  const PresetDocument document(text, source);
  const PresetReader root = document.root();
  root.expect_only({"skyfit_sequence", "frames_per_second", "frames", "keyframes"});
  if (root.number("skyfit_sequence") != kSequenceVersion)
    root.fail_value("skyfit_sequence",
                    fmt::format("{}, the version this program reads", kSequenceVersion));
  Sequence sequence;
  if (root.has("frames_per_second")) {
    sequence.frames_per_second = root.number("frames_per_second");
    if (!(sequence.frames_per_second >= 0.001 && sequence.frames_per_second <= 1000))
      root.fail_value("frames_per_second", "0.001 to 1000");
  }
  Keyframe before = start;
  Calendar calendar;
  for (const PresetReader& object : root.objects("keyframes")) {
    before = read_keyframe(object, before, sources, calendar);
    const bool is_first = sequence.keyframes.empty();
    if (!(is_first ? before.time_s >= 0 : before.time_s > sequence.keyframes.back().time_s))
      object.fail_value("time_s",
                        is_first ? "seconds >= 0" : "more seconds than in the keyframe before");
    if (!is_first) {
      object.complaining([&] {
        require_one_kind(sequence.keyframes.front().camera, before.camera);
        return 0;
      });
    }
    sequence.keyframes.push_back(before);
  }
  if (sequence.keyframes.empty()) root.fail_value("keyframes", "at least one");
  sequence.frames = frame_count(root, sequence);
  validate(sequence);
  return sequence;
}

}  // namespace skyfit
