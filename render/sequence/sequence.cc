// SPDX-License-Identifier: Apache-2.0
#include "render/sequence/sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace skyfit {
namespace {

SunDirection direction_of(const SunSetting& sun, const CameraPose& camera, const SunAt& sun_at) {
  return sun.time ? sun_at(*sun.time, camera.place.value()) : sun.direction;
}

void require(bool good, std::string_view field, double value, std::string_view expected) {
  if (!good)
    throw std::invalid_argument(
        fmt::format("sequence.{} = {:.9g}: must be {}", field, value, expected));
}

// The keyframes about a time and the share of the way from one to the other.
struct Between {
  const Keyframe &a, &b;
  double share;
};

Between between(const Sequence& sequence, double time_s) {
  const std::vector<Keyframe>& keys = sequence.keyframes;
  const auto next = std::ranges::upper_bound(keys, time_s, {}, &Keyframe::time_s);
  const Keyframe& b = next == keys.end() ? keys.back() : *next;
  const Keyframe& a = next == keys.begin() ? keys.front() : *(next - 1);
  const double length = b.time_s - a.time_s;
  return {a, b, length > 0 ? (time_s - a.time_s) / length : 0};
}

std::optional<Instant> instant_at(const Between& at) {
  if (!at.a.sun.time || !at.b.sun.time) return {};
  const auto passed =
      std::chrono::duration<double, std::milli>(*at.b.sun.time - *at.a.sun.time) * at.share;
  return *at.a.sun.time + std::chrono::round<std::chrono::milliseconds>(passed);
}

}  // namespace

void validate(const Sequence& sequence) {
  require(sequence.frames_per_second >= 0.001 && sequence.frames_per_second <= 1000,
          "frames_per_second", sequence.frames_per_second, "0.001 to 1000");
  require(sequence.frames >= 1 && sequence.frames <= kMaxSequenceFrames, "frames", sequence.frames,
          fmt::format("1 to {}", kMaxSequenceFrames));
  if (sequence.keyframes.empty())
    throw std::invalid_argument("sequence.keyframes: must be at least one");
  for (const Keyframe& keyframe : sequence.keyframes) {
    validate(keyframe.camera);
    require_one_kind(sequence.keyframes.front().camera, keyframe.camera);
    if (keyframe.sun.time && !keyframe.camera.place)
      throw std::invalid_argument(
          "sun.time: expected a camera with latitude_deg and longitude_deg");
  }
}

double scene_seconds(const Sequence& sequence, int from, int to) {
  const double begin_s = sequence.time_s(from), end_s = sequence.time_s(to);
  const auto begin = instant_at(between(sequence, begin_s)),
             end = instant_at(between(sequence, end_s));
  if (!begin || !end) return std::abs(end_s - begin_s);
  return std::abs(std::chrono::duration<double>(*end - *begin).count());
}

Shot shot_at(const Sequence& sequence, double time_s, const SunAt& sun_at) {
  const Between at = between(sequence, time_s);
  const auto& [a, b, share] = at;
  const CameraPose camera = pose_between(a.camera, b.camera, share);
  if (const auto time = instant_at(at)) return {camera, sun_at(*time, camera.place.value())};
  return {camera, sun_between(direction_of(a.sun, a.camera, sun_at),
                              direction_of(b.sun, b.camera, sun_at), share)};
}

}  // namespace skyfit
