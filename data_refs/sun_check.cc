// SPDX-License-Identifier: Apache-2.0
#include "data_refs/sun_check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "data_refs/civil_time.h"
#include "data_refs/seen_sun.h"
#include "data_refs/solar_position.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
// The pointing of a scanner may be off by 6 deg; the sun of a wrong hour is off by 13 deg or more.
constexpr double kRefused = 8 * kRadiansPerDegree, kNoted = 2 * kRadiansPerDegree;

struct Disagreement {
  SeenSun seen;
  double stated_zenith;
  const Scan* scan;
  double apart() const { return seen_from_stated(seen, stated_zenith); }
};

// A change and the angle that it would leave between the two suns.
struct Mend {
  std::string text;
  double apart;
};

bool is_certain(const SeenSun& seen, double apart) {
  constexpr double kSigmas = 4, kClearlyBetter = 1.2;
  return apart > kSigmas * seen.sigma && seen.stated_misfit > kClearlyBetter * seen.misfit;
}

std::string degrees(double angle) { return fmt::format("{:.1f} deg", angle * kDegreesPerRadian); }

std::string minutes_off(int minutes) {
  return fmt::format("a clock that is {} min {}", std::abs(minutes), minutes > 0 ? "slow" : "fast");
}

class Mends {
 public:
  explicit Mends(const Disagreement& d) : d_(d) {
    add_azimuths();
    if (!d.scan->site || d.scan->time_utc.empty() || !d.scan->sun_azimuth) return;
    const auto time =
        instant(std::string_view(d.scan->time_utc).substr(0, d.scan->time_utc.size() - 1), 0);
    if (!time) return;
    add_places(*time, *d.scan->site);
    add_clocks(*time, *d.scan->site);
  }

  // The best, and what is hardly worse.
  std::string text() const {
    constexpr double kGood = 0.4, kAlike = 1.5 * kRadiansPerDegree;
    constexpr std::size_t kMost = 3;
    std::vector<Mend> good;
    for (const Mend& mend : mends_) {
      if (mend.apart < kGood * d_.apart()) good.push_back(mend);
    }
    if (good.empty()) return "no single change of time, place or azimuths would mend it";
    std::ranges::stable_sort(good, {}, &Mend::apart);
    std::vector<std::string> texts;
    for (const Mend& mend : good) {
      if (texts.size() < kMost && mend.apart < good.front().apart + kAlike)
        texts.push_back(fmt::format("{} (leaves {})", mend.text, degrees(mend.apart)));
    }
    return fmt::format("it would be mended by {}", fmt::join(texts, ", or by "));
  }

 private:
  void add(std::string text, double zenith, double relative_azimuth) {
    SeenSun seen = d_.seen;
    seen.relative_azimuth -= relative_azimuth;
    mends_.push_back({std::move(text), seen_from_stated(seen, zenith)});
  }

  void add_azimuths() {
    add("azimuths that count from the opposite side (azimuth_zero)", d_.stated_zenith, kTurn / 2);
    add(fmt::format("an instrument turned {} {}", degrees(std::abs(d_.seen.relative_azimuth)),
                    d_.seen.relative_azimuth > 0 ? "counter-clockwise" : "clockwise"),
        d_.stated_zenith, d_.seen.relative_azimuth);
    if (!d_.scan->sun_azimuth) return;
    // View azimuths v become -v, so that the sun that is seen moves to -v, too.
    const double turned = 2 * (d_.seen.relative_azimuth + *d_.scan->sun_azimuth);
    add("azimuths that turn the other way (azimuth_turns)", d_.stated_zenith, turned);
    add("azimuths that turn the other way from the opposite side (azimuth_turns, azimuth_zero)",
        d_.stated_zenith, turned + kTurn / 2);
  }

  void add_sun(std::string text, Instant time, const Site& site) {
    const SolarPosition sun = solar_position(time, site);
    add(std::move(text), sun.zenith, sun.azimuth - *d_.scan->sun_azimuth);
  }

  void add_places(Instant time, const Site& site) {
    add_sun(fmt::format("longitude_deg = {:.9g}", -site.longitude * kDegreesPerRadian), time,
            {site.latitude, -site.longitude, site.elevation_m});
    add_sun(fmt::format("latitude_deg = {:.9g}", -site.latitude * kDegreesPerRadian), time,
            {-site.latitude, site.longitude, site.elevation_m});
  }

  void add_clocks(Instant time, const Site& site) {
    for (int hours = -12; hours <= 12; ++hours) {
      if (hours == 0) continue;
      add_sun(fmt::format("a clock that is {0} h {1} (utc_offset_h {0} {2})", std::abs(hours),
                          hours > 0 ? "slow" : "fast", hours > 0 ? "less" : "more"),
              time + std::chrono::hours(hours), site);
    }
    std::vector<std::pair<double, int>> minutes;
    for (int m = -40; m <= 40; ++m) {
      const SolarPosition sun = solar_position(time + std::chrono::minutes(m), site);
      SeenSun seen = d_.seen;
      seen.relative_azimuth -= sun.azimuth - *d_.scan->sun_azimuth;
      minutes.push_back({seen_from_stated(seen, sun.zenith), m});
    }
    const auto [apart, best] = *std::ranges::min_element(minutes);
    if (best != 0) mends_.push_back({minutes_off(best), apart});
  }

  const Disagreement& d_;
  std::vector<Mend> mends_;
};

std::string text_of(const std::string& sky, const Disagreement& d) {
  const double higher = d.stated_zenith - d.seen.zenith;
  const std::string who =
      d.scan->time_utc.empty() ? "the stated sun" : "the sun of its time and place";
  return fmt::format(
      "{}: the light of the sky puts the sun {} from {} (zenith {}): {} {}, {} {}; {}",
      sky.ends_with(d.scan->name) ? sky : fmt::format("{}: {}", sky, d.scan->name),
      degrees(d.apart()), who, degrees(d.stated_zenith), degrees(std::abs(higher)),
      higher > 0 ? "higher" : "lower", degrees(std::abs(d.seen.relative_azimuth)),
      d.seen.relative_azimuth > 0 ? "clockwise" : "counter-clockwise", Mends(d).text());
}

}  // namespace

void check_suns(const ImportOptions& facts, Reference& sky) {
  std::vector<std::vector<Sample>> samples(sky.scans.size());
  for (const Sample& s : sky.samples) {
    if (static_cast<std::size_t>(s.scan) < samples.size())
      samples[static_cast<std::size_t>(s.scan)].push_back(s);
  }
  std::vector<Disagreement> noted;
  int telling = 0, refused = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto seen = seen_sun(samples[i]);
    if (!seen || seen->sigma > kNoted) continue;
    ++telling;
    const Disagreement d{*seen, samples[i].front().sun_zenith, &sky.scans[i]};
    if (d.apart() < kNoted || !is_certain(*seen, d.apart())) continue;
    noted.push_back(d);
    if (d.apart() > kRefused) ++refused;
  }
  if (2 * refused > telling && !facts.accept_sun) {
    const auto worst = std::ranges::max_element(noted, {}, &Disagreement::apart);
    throw std::invalid_argument(text_of(sky.name, *worst) +
                                "; --accept-sun takes the sun as it is stated");
  }
  constexpr std::size_t kMostNotes = 5;
  for (std::size_t i = 0; i < std::min(kMostNotes, noted.size()); ++i)
    sky.notes.push_back(text_of(sky.name, noted[i]));
  if (noted.size() > kMostNotes)
    sky.notes.push_back(fmt::format("the light of {} more scans puts the sun elsewhere",
                                    noted.size() - kMostNotes));
}

}  // namespace skyfit::refs
