// SPDX-License-Identifier: Apache-2.0
#include "data_refs/sun_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "data_refs/civil_time.h"
#include "data_refs/seen_sun.h"
#include "data_refs/solar_position.h"
#include "data_refs/sun_mends.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
// The pointing of a scanner may be off by 6 deg; the sun of a wrong hour is off by 13 deg or more.
constexpr double kRefused = 8 * kRadiansPerDegree, kNoted = 2 * kRadiansPerDegree;
constexpr double kAlike = 1.5 * kRadiansPerDegree;  // of mends that the light hardly tells apart

struct Disagreement {
  SeenSun seen;
  double stated_zenith;
  const Scan* scan;
  double apart() const { return seen_from_stated(seen, stated_zenith); }
};

// Clouds of another brightness may move the sun that is seen; the stated one then fits nearly as
// well, or what is brightest is near it. Skies with their pixels in the wrong places, as of a wrong
// projection, fit no sun well.
bool is_certain(const SeenSun& seen, double apart) {
  constexpr double kSigmas = 4, kClearlyBetter = 1.2, kBetter = 1.1, kFar = 45 * kRadiansPerDegree;
  const double better = seen.brightest > kFar ? kBetter : kClearlyBetter;
  return apart > kSigmas * seen.sigma && seen.stated_misfit > better * seen.misfit;
}

std::string degrees(double angle) { return fmt::format("{:.1f} deg", angle * kDegreesPerRadian); }

// Of a scan whose time, place and azimuths are known.
std::optional<Instant> time_of(const Scan& scan) {
  if (!scan.site || scan.time_utc.empty() || !scan.sun_azimuth) return {};
  return instant(std::string_view(scan.time_utc).substr(0, scan.time_utc.size() - 1), 0);
}

// The angle between the sun that is seen and another one, where azimuths of the sky are turned by
// `turn`.
AngleToSun angle_to_seen(const SeenSun& seen, const Scan& scan, double turn = 0) {
  return [seen, stated = *scan.sun_azimuth, turn](const SolarPosition& sun) {
    SeenSun moved = seen;
    moved.relative_azimuth += turn - (sun.azimuth - stated);
    return seen_from_stated(moved, sun.zenith);
  };
}

std::vector<Mend> mends_of_azimuths(const Disagreement& d) {
  std::vector<Mend> mends;
  const auto add = [&](std::string text, double relative_azimuth) {
    SeenSun seen = d.seen;
    seen.relative_azimuth -= relative_azimuth;
    mends.push_back({std::move(text), seen_from_stated(seen, d.stated_zenith)});
  };
  add("azimuths that count from the opposite side (azimuth_zero)", kTurn / 2);
  add(fmt::format("an instrument turned {} {}", degrees(std::abs(d.seen.relative_azimuth)),
                  d.seen.relative_azimuth > 0 ? "counter-clockwise" : "clockwise"),
      d.seen.relative_azimuth);
  if (!d.scan->sun_azimuth) return mends;
  // View azimuths v become -v, so that the sun that is seen moves to -v, too.
  const double turned = 2 * (d.seen.relative_azimuth + *d.scan->sun_azimuth);
  add("azimuths that turn the other way (azimuth_turns)", turned);
  add("azimuths that turn the other way from the opposite side (azimuth_turns, azimuth_zero)",
      turned + kTurn / 2);
  return mends;
}

std::string mends_of(const Disagreement& d) {
  std::vector<Mend> mends = mends_of_azimuths(d);
  if (const auto time = time_of(*d.scan))
    std::ranges::move(mends_of_time_and_place(*time, *d.scan->site, angle_to_seen(d.seen, *d.scan)),
                      std::back_inserter(mends));
  return mended_by(std::move(mends), d.apart(), kAlike);
}

std::string text_of(const std::string& sky, const Disagreement& d) {
  const double higher = d.stated_zenith - d.seen.zenith;
  const std::string who =
      d.scan->time_utc.empty() ? "the stated sun" : "the sun of its time and place";
  return fmt::format(
      "{}: the light of the sky puts the sun {} from {} (zenith {}): {} {}, {} {}; {}",
      sky.ends_with(d.scan->name) ? sky : fmt::format("{}: {}", sky, d.scan->name),
      degrees(d.apart()), who, degrees(d.stated_zenith), degrees(std::abs(higher)),
      higher > 0 ? "higher" : "lower", degrees(std::abs(d.seen.relative_azimuth)),
      d.seen.relative_azimuth > 0 ? "clockwise" : "counter-clockwise", mends_of(d));
}

std::string refusal_of(const std::string& sky, const Disagreement& d) {
  return text_of(sky, d) + "; --accept-sun takes the sun as it is stated";
}

void mask_scan(std::ptrdiff_t scan, Reference& sky) {
  for (Sample& s : sky.samples) {
    if (s.scan != scan || !(s.weight > 0)) continue;
    s.weight = 0;
    s.zero_weight_reason = "the light puts the sun elsewhere";
  }
}

// Of the first ones, and how many `more` there are.
template <class Text>
void add_notes(const std::vector<Disagreement>& all, Text text,
               fmt::format_string<std::size_t> more, Reference& sky) {
  constexpr std::size_t kMost = 5;
  for (std::size_t i = 0; i < std::min(kMost, all.size()); ++i) sky.notes.push_back(text(all[i]));
  if (all.size() > kMost) sky.notes.push_back(fmt::format(more, all.size() - kMost));
}

std::vector<std::vector<Sample>> samples_by_scan(const Reference& sky) {
  std::vector<std::vector<Sample>> samples(sky.scans.size());
  for (const Sample& s : sky.samples) {
    if (static_cast<std::size_t>(s.scan) < samples.size())
      samples[static_cast<std::size_t>(s.scan)].push_back(s);
  }
  return samples;
}

}  // namespace

std::string mends_from_either_zero(const Reference& from_north) {
  const std::vector<std::vector<Sample>> samples = samples_by_scan(from_north);
  std::optional<SeenSun> clearest;
  std::size_t scan = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto seen = seen_sun(samples[i]);
    if (!seen || seen->sigma > kNoted || (clearest && clearest->sigma < seen->sigma)) continue;
    clearest = seen;
    scan = i;
  }
  if (!clearest) return {};
  const auto time = time_of(from_north.scans[scan]);
  if (!time) return {};
  const Site& site = *from_north.scans[scan].site;
  double apart = kTurn;
  std::vector<Mend> mends;
  for (const auto& [zero, turn] : {std::pair{"north", 0.0}, {"south", kTurn / 2}}) {
    const AngleToSun angle = angle_to_seen(*clearest, from_north.scans[scan], turn);
    apart = std::min(apart, angle(solar_position(*time, site)));
    for (Mend mend : mends_of_time_and_place(*time, site, angle)) {
      mend.text += fmt::format(" with azimuth_zero {}", zero);
      mends.push_back(std::move(mend));
    }
  }
  return mended_by(std::move(mends), apart, kAlike);
}

void check_suns(const ImportOptions& facts, Reference& sky) {
  const std::vector<std::vector<Sample>> samples = samples_by_scan(sky);
  std::vector<Disagreement> noted, refused;
  std::size_t telling = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto seen = seen_sun(samples[i]);
    if (!seen || seen->sigma > kNoted) continue;
    ++telling;
    const Disagreement d{*seen, samples[i].front().sun_zenith, &sky.scans[i]};
    if (d.apart() < kNoted || !is_certain(*seen, d.apart())) continue;
    (d.apart() > kRefused && !facts.accept_sun ? refused : noted).push_back(d);
  }
  if (2 * refused.size() > telling) {
    const auto worst = std::ranges::max_element(refused, {}, &Disagreement::apart);
    throw std::invalid_argument(refusal_of(sky.name, *worst));
  }
  for (const Disagreement& d : refused) mask_scan(d.scan - sky.scans.data(), sky);
  add_notes(
      refused,
      [&](const Disagreement& d) { return "a scan is left out: " + refusal_of(sky.name, d); },
      "{} more scans are left out", sky);
  add_notes(
      noted, [&](const Disagreement& d) { return text_of(sky.name, d); },
      "the light of {} more scans puts the sun elsewhere", sky);
}

}  // namespace skyfit::refs
