// SPDX-License-Identifier: Apache-2.0
#include "data_refs/photometer_scans.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

std::vector<Reading> readings_of(const PhotometerLine& line, const ScanSun& sun) {
  std::vector<Reading> readings;
  std::set<double> values;
  for (const PhotometerReading& read : line.readings) {
    Reading reading;
    reading.number = static_cast<int>(readings.size());
    reading.wavelength_nm = line.wavelength_nm;
    // < 0: beyond the zenith
    const double zenith_deg = sun.zenith / kRadiansPerDegree - read.up_deg;
    reading.view_zenith_deg = std::abs(zenith_deg);
    reading.view_azimuth_deg = sun.azimuth.value_or(0) / kRadiansPerDegree + read.clockwise_deg +
                               (zenith_deg < 0 ? 180 : 0);
    reading.value = read.radiance.value_or(0);
    if (read.radiance) values.insert(*read.radiance);
    reading.polarisation = read.polarisation;
    reading.flaw = read.radiance ? read.flaw : "missing";
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

std::string_view path_name(ScanPath path) {
  return path == ScanPath::kAlmucantar ? "almucantar" : "principal plane";
}

PhotometerReading reading_along(ScanPath path, double deg, std::optional<double> radiance) {
  const bool is_plane = path == ScanPath::kPrincipalPlane;
  return {is_plane ? deg : 0, is_plane ? 0 : deg, radiance};
}

MeasuredSky photometer_sky(std::string_view source, const ImportOptions& options,
                           std::string_view unit) {
  ScanHeader layout;
  layout.facts.unit = unit;
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
    sky_.begin_scan(fmt::format("{} of {}", path_name(line.path), iso_text(*sun.time)), sun);
    wavelengths_.clear();
  }
  wavelengths_.insert(line.wavelength_nm);
  sky_.move_sun(sun);
  last_ = sun.time;
  path_ = line.path;
  site_ = line.site;
}

}  // namespace skyfit::refs
