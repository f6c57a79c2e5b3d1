// SPDX-License-Identifier: Apache-2.0
#include "data_refs/sun_mends.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <utility>

#include "data_refs/samples.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

class Mends {
 public:
  Mends(Instant time, const Site& site, const AngleToSun& angle)
      : time_(time), site_(site), angle_(angle) {}

  std::vector<Mend> all() {
    add_places();
    add_hours();
    add_minutes();
    return std::move(mends_);
  }

 private:
  double left(Instant time, const Site& site) const { return angle_(solar_position(time, site)); }

  void add_places() {
    const auto add = [&](std::string text, double latitude, double longitude) {
      mends_.push_back(
          {std::move(text), left(time_, Site{latitude, longitude, site_.elevation_m})});
    };
    const double latitude = site_.latitude * kDegreesPerRadian,
                 longitude = site_.longitude * kDegreesPerRadian;
    add(fmt::format("longitude_deg = {:.9g}", -longitude), site_.latitude, -site_.longitude);
    add(fmt::format("latitude_deg = {:.9g}", -latitude), -site_.latitude, site_.longitude);
    if (std::abs(site_.longitude) <= std::numbers::pi / 2) {
      add(fmt::format("latitude and longitude exchanged (latitude_deg = {:.9g}, longitude_deg = "
                      "{:.9g})",
                      longitude, latitude),
          site_.longitude, site_.latitude);
    }
  }

  void add_hours() {
    for (int hours = -12; hours <= 12; ++hours) {
      if (hours == 0) continue;
      mends_.push_back(
          {fmt::format("a clock that is {0} h {1} (utc_offset_h {0} {2})", std::abs(hours),
                       hours > 0 ? "slow" : "fast", hours > 0 ? "less" : "more"),
           left(time_ + std::chrono::hours(hours), site_)});
    }
  }

  void add_minutes() {
    std::vector<std::pair<double, int>> minutes;
    for (int m = -40; m <= 40; ++m)
      minutes.push_back({left(time_ + std::chrono::minutes(m), site_), m});
    const auto [apart, best] = *std::ranges::min_element(minutes);
    if (best == 0) return;
    mends_.push_back(
        {fmt::format("a clock that is {} min {}", std::abs(best), best > 0 ? "slow" : "fast"),
         apart});
  }

  Instant time_;
  const Site& site_;
  const AngleToSun& angle_;
  std::vector<Mend> mends_;
};

}  // namespace

AngleToSun angle_to_stated(double zenith, std::optional<double> azimuth) {
  return [=](const SolarPosition& sun) {
    Sample between;  // the angle between two suns, as that between sun and view
    between.sun_zenith = sun.zenith;
    between.view_zenith = zenith;
    if (azimuth) between.relative_azimuth = *azimuth - sun.azimuth;
    return scattering_angle(between);
  };
}

std::vector<Mend> mends_of_time_and_place(Instant time, const Site& site, const AngleToSun& angle) {
  return Mends(time, site, angle).all();
}

std::string mends_above_horizon(Instant time, const Site& site,
                                std::optional<double> utc_offset_h) {
  std::vector<std::string> texts;
  const auto add = [&](std::string text, Instant then, const Site& there) {
    const double zenith = solar_position(then, there).zenith;
    if (zenith < 0.5 * std::numbers::pi)
      texts.push_back(
          fmt::format("{} would put it at {:.1f} deg", text, zenith * kDegreesPerRadian));
  };
  const double longitude = site.longitude * kDegreesPerRadian;
  add(fmt::format("longitude_deg = {:.9g}", -longitude), time,
      Site{site.latitude, -site.longitude, site.elevation_m});
  // Clocks are ahead of the sun's mean time by up to two hours; formats with times in UTC have 0.
  constexpr double kMost = 2;
  const double of_longitude = std::round(std::remainder(longitude, 360) / 15),
               off = utc_offset_h.value_or(of_longitude) - of_longitude;
  if (utc_offset_h != 0 && std::abs(off) > kMost)
    add(fmt::format("utc_offset_h = {:.9g}", of_longitude),
        time + std::chrono::seconds(std::lround(3600 * off)), site);
  return texts.empty() ? "" : "; " + fmt::format("{}", fmt::join(texts, ", "));
}

std::string mended_by(std::vector<Mend> mends, double apart, double alike) {
  constexpr double kGood = 0.4;
  constexpr std::size_t kMost = 3;
  std::erase_if(mends, [&](const Mend& mend) { return !(mend.apart < kGood * apart); });
  if (mends.empty()) return "no single change of time, place or azimuths would mend it";
  std::ranges::stable_sort(mends, {}, &Mend::apart);
  std::vector<std::string> texts;
  for (const Mend& mend : mends) {
    if (texts.size() < kMost && mend.apart < mends.front().apart + alike)
      texts.push_back(
          fmt::format("{} (leaves {:.1f} deg)", mend.text, mend.apart * kDegreesPerRadian));
  }
  return fmt::format("it would be mended by {}", fmt::join(texts, ", or by "));
}

}  // namespace skyfit::refs
