// SPDX-License-Identifier: Apache-2.0
#include "data_refs/photometer_scans.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

std::string_view name_of(ScanPath path) {
  return path == ScanPath::kAlmucantar ? "almucantar" : "principal plane";
}

std::vector<Reading> readings_of(const PhotometerLine& line, const ScanSun& sun) {
  std::vector<Reading> readings;
  std::set<double> values;
  const bool is_plane = line.path == ScanPath::kPrincipalPlane;
  for (const auto& [deg, value] : line.radiances) {
    Reading reading;
    reading.number = static_cast<int>(readings.size());
    reading.wavelength_nm = line.wavelength_nm;
    const double up_deg = is_plane ? deg : 0, turn_deg = is_plane ? 0 : deg;
    const double zenith_deg = sun.zenith / kRadiansPerDegree - up_deg;  // < 0: beyond the zenith
    reading.view_zenith_deg = std::abs(zenith_deg);
    reading.view_azimuth_deg =
        sun.azimuth.value_or(0) / kRadiansPerDegree + (zenith_deg < 0 ? 180 : turn_deg);
    reading.value = value.value_or(0);
    if (value) values.insert(*value);
    reading.flaw = value ? "" : "missing";
    readings.push_back(reading);
  }
  constexpr std::size_t kFewest = 10;  // that chance does not make equal
  if (values.size() == 1 && readings.size() >= kFewest) {
    for (Reading& reading : readings) {
      if (reading.flaw.empty()) reading.flaw = "one value in every direction";
    }
  }
  return readings;
}

}  // namespace

MeasuredSky photometer_sky(std::string_view source, const ImportOptions& options) {
  constexpr std::string_view kUnit = "uW cm-2 sr-1 nm-1";
  ScanHeader layout;
  layout.facts.unit = kUnit;
  ImportOptions facts = options;
  facts.azimuth_zero.reset();  // azimuths count from the sun
  facts.azimuth_turns.reset();
  return MeasuredSky(std::string(source),
                     stated_unit(layout, options, source, {Quantity::kSpectralRadiance}), facts);
}

void PhotometerScans::add(const PhotometerLine& line) {
  const ScanSun sun = sun_of_scan(overlaid(options_, line.facts), line.place, false);
  const std::vector<Reading> readings = readings_of(line, sun);
  place_in_scan(line, sun);
  for (const Reading& reading : readings) sky_.add(reading);
}

void PhotometerScans::place_in_scan(const PhotometerLine& line, const ScanSun& sun) {
  constexpr std::chrono::minutes kLongestPause{15};
  const bool goes_on = last_ && *sun.time - *last_ <= kLongestPause && *sun.time >= *last_ &&
                       line.path == path_ && line.site == site_ &&
                       !wavelengths_.contains(line.wavelength_nm);
  if (!goes_on) {
    sky_.begin_scan(fmt::format("{} of {}", name_of(line.path), iso_text(*sun.time)), sun);
    wavelengths_.clear();
  }
  wavelengths_.insert(line.wavelength_nm);
  sky_.move_sun(sun);
  last_ = sun.time;
  path_ = line.path;
  site_ = line.site;
}

}  // namespace skyfit::refs
