// SPDX-License-Identifier: Apache-2.0
// What every reader of a measured sky shares: the sun of a scan, and how readings become the
// samples of a Reference. A reading that cannot be used stays, with weight 0 and a reason.
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "data_refs/civil_time.h"
#include "data_refs/import_options.h"
#include "data_refs/samples.h"
#include "data_refs/scan_header.h"
#include "data_refs/solar_position.h"
#include "data_refs/units.h"

namespace skyfit::refs {

// Of one scan. Radians, azimuth clockwise from north; where it is not known, azimuths of the
// readings count from the sun.
struct ScanSun {
  double zenith = 0;
  std::optional<double> azimuth;
  double distance_au = 1;
  std::optional<Instant> time;
  std::optional<double> elevation_m;  // of the site
  std::optional<Site> site = {};      // that the sun was computed for
  std::string remark;                 // what to note of it; empty otherwise
};

// The instant of local_time; nothing where that is not stated. Throws std::invalid_argument that
// begins with `place` where it is no time, or its offset to UTC is missing or contradicted.
std::optional<Instant> stated_time(const ImportOptions& facts, std::string_view place);

// From time and place; a sun that is stated beside them must agree within kSunAgreement_deg, as it
// is or as refraction shows it. Where time or place is missing, the stated one. Throws
// std::invalid_argument that begins with `place` when neither is known, they disagree or the sun is
// below the horizon.
inline constexpr double kSunAgreement_deg = 0.25;  // one minute of time; the sun's radius
ScanSun sun_of_scan(const ImportOptions& facts, std::string_view place,
                    bool azimuth_is_needed = true);

// The unit of the values, from the file or from the options, which may not contradict each other;
// it must be of one of the quantities. Throws std::invalid_argument that lists the accepted units.
Unit stated_unit(const ScanHeader& header, const ImportOptions& options, std::string_view source,
                 std::initializer_list<Quantity> quantities);

struct Reading {
  int number = 0;                                    // of the direction in the file
  double view_zenith_deg = 0, view_azimuth_deg = 0;  // azimuth as the file counts it
  double wavelength_nm = 0;
  double value = 0;                                    // in the unit of the file
  std::vector<PolarisationReading> polarisation = {};  // of the same light
  std::string flaw;                                    // what the reader knows against it
};

// How a format counts azimuths when the facts do not say.
struct AzimuthSense {
  bool from_south = false, counter_clockwise = false;
};

class MeasuredSky {
 public:
  MeasuredSky(std::string source, const Unit& unit, const ImportOptions& facts,
              AzimuthSense sense = {});

  // The readings that follow are of this scan.
  void begin_scan(std::string name, const ScanSun& sun);
  // The readings that follow, of the same scan, have this sun.
  void move_sun(const ScanSun& sun) { sun_ = sun; }
  void add(const Reading& reading);

  void note(std::string text) { reference_.notes.push_back(std::move(text)); }

  // Throws std::invalid_argument when no sample has a weight or an excluded one does not exist.
  Reference finish();

 private:
  std::string flaw_of(const Reading& reading, const Sample& sample) const;

  Unit unit_;
  ImportOptions facts_;
  AzimuthSense sense_;
  Reference reference_;
  ScanSun sun_;  // of the last scan
  double first_sun_azimuth_ = 0;
  std::set<int> numbers_;  // of all directions that were read
};

// Scans (or lines) of a file that cannot be used: the others are read all the same.
class LeftOut {
 public:
  explicit LeftOut(std::string what) : what_(std::move(what)) {}

  // Whether `read` did not throw std::invalid_argument.
  bool attempt(const std::function<void()>& read);

  // What was left out and why. Throws the first complaint when nothing was read.
  std::vector<std::string> notes() const;

 private:
  std::string what_;
  int read_ = 0;
  std::vector<std::string> complaints_;
};

}  // namespace skyfit::refs
