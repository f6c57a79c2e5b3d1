// SPDX-License-Identifier: Apache-2.0
// A sequence of frames: keyframes of camera, sun and timeline, and what lies between them. Read
// from JSON:
//
//     {"skyfit_sequence": 1, "frames_per_second": 24, "frames": 241, "keyframes": [
//       {"time_s": 0, "preset": "earth-clear",
//        "camera": {"latitude_deg": 47, "longitude_deg": 8, "above_ground_m": 2, "heading_deg":
//        90}, "sun": {"date": "2026-06-21", "time": "04:00", "utc_offset_h": 0}},
//       {"time_s": 10, "parameters": {"mie.scattering": 6e-5}, "sun": {"time": "08:00"}}]}
//
// A keyframe leaves out what stays as in the keyframe before; the first, what the command line
// says. camera: view (a named one), latitude_deg and longitude_deg, altitude_m (above the bottom
// radius) or above_ground_m, azimuth_deg (from the sun) or heading_deg (from north), pitch_deg or
// view_zenith_deg, or look_at {latitude_deg, longitude_deg, altitude_m}; field_of_view_deg. sun:
// zenith_deg and azimuth_deg (from north), or date, time and utc_offset_h. preset: a name or a
// file; parameters: of the table (model/atmosphere/parameters.h), in its units. Without "frames"
// the sequence ends at the last keyframe.
#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/atmosphere/preset.h"
#include "render/scene/placement.h"

namespace skyfit {

using Instant = std::chrono::sys_time<std::chrono::milliseconds>;

struct SunSetting {
  SunDirection direction;
  std::optional<Instant> time;  // instead of the direction: the sun over the camera's place
};

struct Keyframe {
  double time_s = 0;
  CameraPose camera;
  SunSetting sun;
  Preset preset;
};

struct Sequence {
  double frames_per_second = 24;
  int frames = 1;
  std::vector<Keyframe> keyframes;  // at least one, ascending in time

  double time_s(int frame) const { return frame / frames_per_second; }
};

inline constexpr int kMaxSequenceFrames = 100'000;

// What this library does not know.
struct SequenceSources {
  std::function<Preset(const std::string& name_or_file)> preset;
  std::function<std::optional<Instant>(const std::string& date, const std::string& clock,
                                       double utc_offset_h)>
      instant;
};

// `start` is what the first keyframe may leave out; its time is not used. Throws
// std::invalid_argument with one line that names source, line, field, value and what was expected;
// and what `sources` throw.
Sequence parse_sequence(std::string_view text, std::string_view source, const Keyframe& start,
                        const SequenceSources& sources);

// Throws std::invalid_argument `sequence.field = value: must be ...`.
void validate(const Sequence& sequence);

// Where the sun stands over a place, north as SunDirection has it.
using SunAt = std::function<SunDirection(Instant, const Place&)>;

struct Shot {
  CameraPose camera;
  SunDirection sun;
};

// How long it takes in the scene from one frame to another, s: by the clock where the sun has one,
// so that minutes may pass between two frames of a day; by the sequence where it has none.
double scene_seconds(const Sequence& sequence, int from, int to);

// Before the first keyframe and after the last, theirs.
Shot shot_at(const Sequence& sequence, double time_s, const SunAt& sun_at);

}  // namespace skyfit
