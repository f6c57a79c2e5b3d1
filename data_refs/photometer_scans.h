// SPDX-License-Identifier: Apache-2.0
// Scans of a sun photometer along the almucantar or the principal plane of the sun. Each line is
// one wavelength with its own time and sun; lines along one path that follow each other within 15
// min without repeating a wavelength are a scan.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "data_refs/civil_time.h"
#include "data_refs/import_options.h"
#include "data_refs/measured_sky.h"
#include "data_refs/scan_header.h"

namespace skyfit::refs {

enum class ScanPath {
  kAlmucantar,      // at the sun's height
  kPrincipalPlane,  // through sun and zenith
};

std::string_view path_name(ScanPath path);  // "almucantar"

struct PhotometerReading {
  double up_deg, clockwise_deg;    // from the sun
  std::optional<double> radiance;  // in the unit of photometer_sky(); nothing where it is missing
  std::vector<PolarisationReading> polarisation = {};  // of the same light
  std::string flaw = {};                               // what the reader knows against it
};

struct PhotometerLine {
  std::string place;  // "file:12", for messages
  ScanPath path;
  std::string site;  // empty: not known
  double wavelength_nm;
  ImportOptions facts;  // time, place and the sun's zenith angle
  // A line that has one radiance throughout holds no measurement.
  std::vector<PhotometerReading> readings;
};

// A reading at an angle along the path: an azimuth from the sun, or in the principal plane upward.
PhotometerReading reading_along(ScanPath path, double deg, std::optional<double> radiance);

// For the lines of PhotometerScans, whose radiances are in the unit.
inline constexpr std::string_view kAeronetUnit = "uW cm-2 sr-1 nm-1";
MeasuredSky photometer_sky(std::string_view source, const ImportOptions& options,
                           std::string_view unit = kAeronetUnit);

class PhotometerScans {
 public:
  // Both outlive it.
  PhotometerScans(const ImportOptions& options, MeasuredSky& sky) : options_(options), sky_(sky) {}

  // Throws as sun_of_scan() before it adds anything.
  void add(const PhotometerLine& line);

 private:
  void place_in_scan(const PhotometerLine& line, const ScanSun& sun);

  const ImportOptions& options_;
  MeasuredSky& sky_;
  std::set<double> wavelengths_;  // of the scan
  std::optional<Instant> last_;
  ScanPath path_{};
  std::string site_;
};

}  // namespace skyfit::refs
