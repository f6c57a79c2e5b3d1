// SPDX-License-Identifier: Apache-2.0
#include "data_refs/measured_sky.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>
#include <vector>

#include "data_refs/absorption_bands.h"
#include "data_refs/solar_position.h"
#include "data_refs/spectra.h"
#include "data_refs/sun_mends.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

[[noreturn]] void fail(std::string_view place, const std::string& message) {
  throw std::invalid_argument(fmt::format("{}: {}", place, message));
}

// What to note of the stated sun; throws when it is another one.
std::string expect_agreement(const ImportOptions& facts, const SolarPosition& sun, Instant time,
                             const Site& site, std::string_view place) {
  if (!facts.sun_zenith_deg) return {};
  std::optional<double> azimuth;
  if (facts.sun_azimuth_deg) azimuth = *facts.sun_azimuth_deg * kRadiansPerDegree;
  const AngleToSun angle = angle_to_stated(*facts.sun_zenith_deg * kRadiansPerDegree, azimuth);
  constexpr double kAgreement = kSunAgreement_deg * kRadiansPerDegree;
  const double apart = angle(sun);
  if (apart <= kAgreement) return {};
  SolarPosition apparent = sun;
  apparent.zenith -= refraction(sun.zenith);
  if (angle(apparent) <= kAgreement) {
    return fmt::format(
        "sun_zenith_deg = {:.9g} is the apparent sun: refraction raises the sun of {} "
        "from zenith {:.3f} deg, where the model has it",
        *facts.sun_zenith_deg, iso_text(time), sun.zenith / kRadiansPerDegree);
  }
  fail(place,
       fmt::format("sun_zenith_deg = {:.9g}: expected the sun of {} at this site, zenith {:.3f} "
                   "and azimuth {:.3f} deg, within {} deg; it is {:.2f} deg away; {}",
                   *facts.sun_zenith_deg, iso_text(time), sun.zenith / kRadiansPerDegree,
                   sun.azimuth / kRadiansPerDegree, kSunAgreement_deg, apart / kRadiansPerDegree,
                   mended_by(mends_of_time_and_place(time, site, angle), apart, kAgreement)));
}

[[noreturn]] void fail_without_sun(const ImportOptions& facts, std::string_view place) {
  std::vector<std::string_view> missing;
  if (!facts.local_time) missing.push_back("local_time");
  if (!facts.latitude_deg) missing.push_back("latitude_deg");
  if (!facts.longitude_deg) missing.push_back("longitude_deg");
  fail(place,
       fmt::format("the sun is not known: expected {}, or sun_zenith_deg and sun_azimuth_deg",
                   fmt::join(missing, ", ")));
}

// E.g. "1 scan", "2 scans"
std::string counted(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

// Hours that local_time is ahead of UTC, by its own text or beside it.
double clock_offset_h(const ImportOptions& facts) {
  return stated_utc_offset_h(*facts.local_time).value_or(facts.utc_offset_h.value_or(0));
}

}  // namespace

std::optional<Instant> stated_time(const ImportOptions& facts, std::string_view place) {
  if (!facts.local_time) return {};
  if (!instant(*facts.local_time, 0))
    fail(place, fmt::format("local_time = {}: expected {}", *facts.local_time, kTimeForm));
  const std::optional<double> in_text = stated_utc_offset_h(*facts.local_time);
  if (!in_text && !facts.utc_offset_h)
    fail(place, "utc_offset_h: not stated, expected the hours that local_time is ahead of UTC");
  if (in_text && facts.utc_offset_h && *in_text != *facts.utc_offset_h) {
    fail(place, fmt::format("utc_offset_h = {:.9g}: expected {:.9g}, as local_time = {} says",
                            *facts.utc_offset_h, *in_text, *facts.local_time));
  }
  return instant(*facts.local_time, clock_offset_h(facts));
}

ScanSun sun_of_scan(const ImportOptions& facts, std::string_view place, bool azimuth_is_needed) {
  ScanSun result;
  result.time = stated_time(facts, place);
  result.elevation_m = facts.elevation_m;
  if (result.time) result.distance_au = sun_distance_au(*result.time);
  if (result.time && facts.latitude_deg && facts.longitude_deg) {
    result.site = {*facts.latitude_deg * kRadiansPerDegree,
                   *facts.longitude_deg * kRadiansPerDegree, facts.elevation_m.value_or(0)};
    const SolarPosition sun = solar_position(*result.time, *result.site);
    result.remark = expect_agreement(facts, sun, *result.time, *result.site, place);
    result.zenith = sun.zenith;
    result.azimuth = sun.azimuth;
  } else if (facts.sun_zenith_deg && (facts.sun_azimuth_deg || !azimuth_is_needed)) {
    result.zenith = *facts.sun_zenith_deg * kRadiansPerDegree;
    if (facts.sun_azimuth_deg) result.azimuth = *facts.sun_azimuth_deg * kRadiansPerDegree;
  } else {
    fail_without_sun(facts, place);
  }
  if (!(result.zenith < 90 * kRadiansPerDegree)) {
    fail(place,
         fmt::format(
             "sun_zenith_deg = {:.6g}{}: expected a sun above the horizon{}",
             result.zenith / kRadiansPerDegree, result.time ? " at " + iso_text(*result.time) : "",
             result.site ? mends_above_horizon(*result.time, *result.site, facts.utc_offset_h)
                         : ""));
  }
  return result;
}

Unit stated_unit(const ScanHeader& header, const ImportOptions& options, std::string_view source,
                 std::initializer_list<Quantity> quantities) {
  const auto unit_from = [&](const std::string& text, std::string_view place) {
    const std::optional<Unit> unit = find_unit(text);
    if (!unit || std::ranges::count(quantities, unit->quantity) == 0)
      fail(place, fmt::format("unit = \"{}\": expected one of {}", text, unit_names(quantities)));
    return *unit;
  };
  const std::optional<std::string>& in_file = header.facts.unit;
  if (!in_file && !options.unit)
    fail(source, fmt::format("unit: not stated, expected one of {}", unit_names(quantities)));
  const std::string place = header.place(source, "unit");
  const Unit unit = in_file ? unit_from(*in_file, place) : unit_from(*options.unit, source);
  if (options.unit && unit_from(*options.unit, source).name != unit.name) {
    fail(place, fmt::format("unit = \"{}\": expected \"{}\", as options or sidecar state", *in_file,
                            *options.unit));
  }
  return unit;
}

MeasuredSky::MeasuredSky(std::string source, const Unit& unit, const ImportOptions& facts,
                         AzimuthSense sense)
    : unit_(unit), facts_(facts), sense_(sense) {
  if (facts.azimuth_zero) sense_.from_south = *facts.azimuth_zero == "south";
  if (facts.azimuth_turns) sense_.counter_clockwise = *facts.azimuth_turns == "counter-clockwise";
  reference_.name = std::move(source);
  reference_.quantity = unit.quantity;
}

void MeasuredSky::begin_scan(std::string name, const ScanSun& sun) {
  Scan scan;
  scan.name = std::move(name);
  if (sun.time) scan.time_utc = iso_text(*sun.time);
  scan.sun_azimuth = sun.azimuth;
  scan.sun_distance_au = sun.distance_au;
  scan.elevation_m = sun.elevation_m;
  scan.site = sun.site;
  reference_.scans.push_back(std::move(scan));
  sun_ = sun;
  first_sun_azimuth_ = sun.azimuth.value_or(0);
  if (!sun.remark.empty()) note(sun.remark);
}

void MeasuredSky::add(const Reading& reading) {
  const double from_north_deg = (sense_.counter_clockwise ? -1 : 1) * reading.view_azimuth_deg +
                                (sense_.from_south ? 180 : 0);
  Sample sample;
  sample.scan = static_cast<int>(reference_.scans.size()) - 1;
  sample.direction = reading.number;
  sample.sun_zenith = sun_.zenith;
  sample.sun_azimuth_since = std::remainder(sun_.azimuth.value_or(0) - first_sun_azimuth_, kTurn);
  sample.view_zenith = reading.view_zenith_deg * kRadiansPerDegree;
  sample.relative_azimuth =
      std::remainder(from_north_deg * kRadiansPerDegree - sun_.azimuth.value_or(0), kTurn);
  sample.wavelength_nm = reading.wavelength_nm;
  sample.value = reading.value * unit_.factor;
  sample.polarisation = reading.polarisation;
  sample.zero_weight_reason = flaw_of(reading, sample);
  if (!sample.zero_weight_reason.empty()) sample.weight = 0;
  numbers_.insert(reading.number);
  reference_.samples.push_back(std::move(sample));
}

std::string MeasuredSky::flaw_of(const Reading& reading, const Sample& sample) const {
  for (const ExcludedSample& excluded : facts_.exclude_samples) {
    if (excluded.sample == reading.number) return excluded.reason;
  }
  if (!reading.flaw.empty()) return reading.flaw;
  if (!(reading.view_zenith_deg < 90)) return "outside the sky";
  if (reading.wavelength_nm > 0 && !has_spectra_at(standard_spectral_data(), reading.wavelength_nm))
    return std::string(kOutsideSpectra);
  if (!std::isfinite(reading.value)) return "not finite";
  if (!(reading.value > 0)) return "not positive";
  if (facts_.saturation && reading.value >= *facts_.saturation) return "saturated";
  if (facts_.near_sun_deg && scattering_angle(sample) < *facts_.near_sun_deg * kRadiansPerDegree)
    return "near the sun";
  return {};
}

bool LeftOut::attempt(const std::function<void()>& read) {
  try {
    read();
  } catch (const std::invalid_argument& complaint) {
    complaints_.emplace_back(complaint.what());
    return false;
  }
  ++read_;
  return true;
}

std::vector<std::string> LeftOut::notes() const {
  constexpr std::size_t kMostNotes = 5;
  if (read_ == 0 && !complaints_.empty()) throw std::invalid_argument(complaints_.front());
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < std::min(kMostNotes, complaints_.size()); ++i)
    notes.push_back(fmt::format("a {} is left out: {}", what_, complaints_[i]));
  if (complaints_.size() > kMostNotes)
    notes.push_back(
        fmt::format("{} more {}s are left out", complaints_.size() - kMostNotes, what_));
  return notes;
}

Reference MeasuredSky::finish() {
  for (const ExcludedSample& excluded : facts_.exclude_samples) {
    if (numbers_.contains(excluded.sample)) continue;
    fail(reference_.name,
         fmt::format("exclude_samples = {}: expected the number of a sample", excluded.sample));
  }
  const auto used =
      std::ranges::count_if(reference_.samples, [](const Sample& s) { return s.weight > 0; });
  if (used == 0) {
    fail(reference_.name,
         fmt::format("none of {} can be used, expected at least 1: {}",
                     counted(reference_.samples.size(), "sample"),
                     reference_.samples.empty() ? "there is none"
                                                : reference_.samples.front().zero_weight_reason));
  }
  reference_.description =
      fmt::format("{} of {} in {} directions and {} from {}",
                  counted(reference_.samples.size(), "sample"), quantity_name(unit_.quantity),
                  numbers_.size(), counted(reference_.scans.size(), "scan"), reference_.name);
  return std::move(reference_);
}

}  // namespace skyfit::refs
