// SPDX-License-Identifier: Apache-2.0
// Sequences: what a file says, what it leaves out, what lies between its keyframes, and the line
// that an error names.
#include "render/sequence/sequence.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "data_refs/civil_time.h"
#include "data_refs/references.h"

namespace skyfit {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;
using namespace std::chrono_literals;

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kRounding = 1e-9;

Preset shipped(const std::string& name) {
  return parse_preset(refs::shipped_preset_json(name), name);
}

Sequence parse(const std::string& text) {
  Keyframe start;
  start.preset = shipped("earth-clear");
  return parse_sequence(text, "day.json", start, {shipped, [](auto& date, auto& clock, double h) {
                                                    return refs::instant(date, clock, h);
                                                  }});
}

Sequence of_keyframes(const std::string& keyframes) {
  return parse("{\"skyfit_sequence\": 1,\n\"keyframes\": [\n" + keyframes + "\n]}");
}

// Not the sun, but something that tells place and time.
SunDirection pretended(Instant time, const Place& place) {
  return {std::chrono::duration<double>(time.time_since_epoch()).count() * 1e-6, place.longitude};
}

TEST(Sequence, KeyframesLeaveOutWhatStays) {
  const Sequence sequence = of_keyframes(
      R"({"time_s": 0, "preset": "mars", "camera": {"latitude_deg": 47, "longitude_deg": 8,
          "above_ground_m": 2, "heading_deg": 90, "pitch_deg": 5}, "sun": {"zenith_deg": 60}},
         {"time_s": 2, "camera": {"heading_deg": 100}},
         {"time_s": 4, "parameters": {"ground.albedo": 0.4}, "sun": {"zenith_deg": 70}})");
  ASSERT_EQ(sequence.keyframes.size(), 3u);
  EXPECT_EQ(sequence.frames, 97);  // 4 s at 24 per second, and the last
  const Keyframe &a = sequence.keyframes[0], &b = sequence.keyframes[1], &c = sequence.keyframes[2];
  EXPECT_NEAR(a.camera.view_zenith, 85 * kDegree, kRounding);
  EXPECT_TRUE(a.camera.above_ground && a.camera.from_north);
  EXPECT_EQ(b.camera.place, a.camera.place);
  EXPECT_NEAR(b.camera.azimuth, 100 * kDegree, kRounding);
  EXPECT_EQ(b.preset.name, "mars");
  EXPECT_EQ(c.preset.atmosphere.ground_albedo, 0.4);
  EXPECT_EQ(c.camera, b.camera);
}

TEST(Sequence, ANamedViewFollowsTheRadiusOfItsPlanet) {
  const auto small = [](const std::string&) {
    Preset preset = shipped("earth-clear");
    preset.atmosphere.bottom_radius_m = 250e3;
    return preset;
  };
  const Sequence sequence = parse_sequence(
      R"({"skyfit_sequence": 1, "keyframes": [
          {"time_s": 0, "preset": "small", "camera": {"view": "limb"}, "sun": {"zenith_deg": 60}}]})",
      "small.json", {},
      {small, [](auto& date, auto& clock, double h) { return refs::instant(date, clock, h); }});
  EXPECT_NEAR(sequence.keyframes[0].camera.altitude_m, 40e3, kRounding);
}

TEST(Sequence, BetweenKeyframes) {
  const Sequence sequence = of_keyframes(
      R"({"time_s": 0, "camera": {"altitude_m": 10, "azimuth_deg": 170, "view_zenith_deg": 90},
          "sun": {"zenith_deg": 40}},
         {"time_s": 10, "camera": {"altitude_m": 1000, "azimuth_deg": -170},
          "sun": {"zenith_deg": 60}})");
  const Shot half = shot_at(sequence, 5, pretended);
  EXPECT_NEAR(half.camera.altitude_m, 100, 1e-6);
  EXPECT_NEAR(half.camera.azimuth, 180 * kDegree, kRounding);
  EXPECT_NEAR(half.sun.zenith, 50 * kDegree, kRounding);
  const Shot last = shot_at(sequence, 100, pretended);
  EXPECT_NEAR(last.camera.altitude_m, 1000, 1e-6);
}

TEST(Sequence, TheSunOfTheDayIsThatOfTimeAndPlace) {
  const Sequence sequence = of_keyframes(
      R"({"time_s": 0, "camera": {"latitude_deg": 0, "longitude_deg": 10},
          "sun": {"date": "1970-01-02", "time": "02:00", "utc_offset_h": 2}},
         {"time_s": 1, "camera": {"latitude_deg": 0, "longitude_deg": 20},
          "sun": {"time": "03:00"}})");
  EXPECT_EQ(*sequence.keyframes[0].sun.time, Instant(24h));
  const Shot shot = shot_at(sequence, 0.5, pretended);
  EXPECT_NEAR(shot.sun.zenith, (24 * 3600 + 1800) * 1e-6, kRounding);
  EXPECT_NEAR(shot.sun.azimuth, 15 * kDegree, kRounding);
}

TEST(Sequence, SceneTimeIsTheClocksWhereTheSunHasOne) {
  const std::string text = R"({"time_s": 0, "camera": {"latitude_deg": 0, "longitude_deg": 10},
          "sun": {"date": "1970-01-02", "time": "02:00"}},
         {"time_s": 1, "sun": {"time": "04:00"}},
         {"time_s": 2, "sun": {"zenith_deg": 60}})";
  const Sequence sequence = of_keyframes(text);
  EXPECT_NEAR(scene_seconds(sequence, 5, 6), 7200.0 / 24, 2e-3);  // milliseconds of an instant
  EXPECT_NEAR(scene_seconds(sequence, 40, 41), 1.0 / 24, kRounding);
  EXPECT_EQ(scene_seconds(sequence, 5, 5), 0);
}

struct Refused {
  const char *keyframes, *place, *what;
};

TEST(Sequence, ErrorsNameLineFieldValueAndExpectation) {
  const Refused cases[] = {
      {R"({"camera": {"altitude_m": 5}})", "day.json:3: keyframes[0].time_s", "missing"},
      {R"({"time_s": "now"})", "day.json:3: keyframes[0].time_s = \"now\"", "a number"},
      {"{\"time_s\": 0},\n{\"time_s\": 0}", "day.json:4: keyframes[1].time_s = 0", "more seconds"},
      {"{\"time_s\": 0,\n\"camera\": {\n\"latitude_deg\": 91, \"longitude_deg\": 0}}",
       "day.json:5: keyframes[0].camera.latitude_deg = 91", "-90 to 90"},
      {R"({"time_s": 0, "camera": {"altitude_m": 0.5}})",
       "day.json:3: keyframes[0].camera.altitude_m = 0.5", "from 1 to"},
      {R"({"time_s": 0, "camera": {"altitude_m": 5, "above_ground_m": 5}})",
       "keyframes[0].camera.above_ground_m = 5", "not beside altitude_m"},
      {R"({"time_s": 0, "camera": {"heading_deg": 5}})", "keyframes[0].camera: heading_deg",
       "with latitude_deg"},
      {R"({"time_s": 0, "camera": {"zoom": 5}})", "keyframes[0].camera.zoom", "unknown name"},
      {R"({"time_s": 0, "camera": {"view": "moon"}})", "keyframes[0].camera.view = \"moon\"",
       "ground"},
      {R"({"time_s": 0, "sun": {"zenith_deg": 200}})", "keyframes[0].sun.zenith_deg = 200",
       "0 to 180"},
      {R"({"time_s": 0, "sun": {"time": "25:00", "date": "2026-06-21"}})",
       "keyframes[0].sun.time = \"25:00\"", "HH:MM"},
      {R"({"time_s": 0, "sun": {"time": "12:00"}})", "keyframes[0].sun.date", "missing"},
      {R"({"time_s": 0, "sun": {"time": "12:00", "date": "2026-06-21"}})", "keyframes[0].sun.time",
       "latitude_deg and longitude_deg"},
      {R"({"time_s": 0, "preset": 3})", "keyframes[0].preset = 3", "a text"},
      {R"({"time_s": 0, "parameters": {"mie.turbidity": 3}})",
       "keyframes[0].parameters.mie.turbidity", "unknown parameter"},
      {R"({"time_s": 0, "parameters": {"ground.albedo": 3}})", "keyframes[0].ground.albedo", "3"},
      {"{\"time_s\": 0},\n{\"time_s\": 1, \"camera\": {\"latitude_deg\": 1, \"longitude_deg\": 0}}",
       "day.json:4: keyframes[1].camera", "in all keyframes or in none"},
      {"5", "keyframes = [5]", "an array of objects"},
      {"", "keyframes = []", "at least one"},
  };
  for (const Refused& refused : cases) {
    EXPECT_THAT([&] { of_keyframes(refused.keyframes); },
                ThrowsMessage<std::invalid_argument>(AllOf(
                    StartsWith("day.json:"), HasSubstr(refused.place), HasSubstr(refused.what))))
        << refused.keyframes;
  }
}

TEST(Sequence, ErrorsOutsideTheKeyframes) {
  const auto refuse = [](const std::string& text, const std::string& what) {
    EXPECT_THAT([&] { parse(text); }, ThrowsMessage<std::invalid_argument>(HasSubstr(what)));
  };
  refuse("{\"skyfit_sequence\": 1,", "day.json:1: expected JSON");
  refuse("{\"skyfit_sequence\": 7, \"keyframes\": []}", "skyfit_sequence = 7");
  refuse("{\"skyfit_sequence\": 1, \"frames\": 0, \"keyframes\": [{\"time_s\": 0}]}", "frames = 0");
  refuse("{\"skyfit_sequence\": 1, \"frames\": 1.5, \"keyframes\": [{\"time_s\": 0}]}",
         "frames = 1.5");
  refuse("{\"skyfit_sequence\": 1, \"keyframes\": [{\"time_s\": 1e9}]}", "at most 100000 frames");
  refuse("{\"skyfit_sequence\": 1, \"frames_per_second\": 0, \"keyframes\": [{\"time_s\": 0}]}",
         "frames_per_second = 0");
}

}  // namespace
}  // namespace skyfit
