// SPDX-License-Identifier: Apache-2.0
#include "data_refs/aeronet_csv.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "data_refs/aeronet_table.h"
#include "data_refs/measured_sky.h"
#include "data_refs/scan_header.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kUnit = "uW cm-2 sr-1 nm-1";
constexpr std::string_view kAlmucantar = "almucantar", kPrincipalPlane = "principal plane";

// The lines of one scan come one after another.
class ScanBuilder {
 public:
  ScanBuilder(const AeronetTable& table, std::string_view source, const ImportOptions& options,
              MeasuredSky& sky)
      : table_(table), source_(source), options_(options), sky_(sky) {}

  // Throws before it adds anything.
  void add(const AeronetLine& line) {
    table_.expect_fields(line);
    const std::string type = table_.scan_type(line);
    if (!type.starts_with(kAlmucantar) && !type.starts_with(kPrincipalPlane)) {
      throw std::invalid_argument(fmt::format(
          "{}:{}: Sky_Scan_Type = \"{}\": expected Almucantar or Principal Plane, whose "
          "directions are known",
          source_, line.number, type));
    }
    const std::string place = fmt::format("{}:{}", source_, line.number);
    const ScanSun sun = sun_of_scan(overlaid(options_, table_.facts(line)), place, false);
    const std::vector<Reading> readings = readings_of(line, type, sun);
    place_in_scan(line, type, sun);
    for (const Reading& reading : readings) sky_.add(reading);
  }

 private:
  std::vector<Reading> readings_of(const AeronetLine& line, const std::string& type,
                                   const ScanSun& sun) const {
    std::vector<Reading> readings;
    std::set<double> values;
    const bool is_plane = type.starts_with(kPrincipalPlane);
    for (const AeronetAngle& angle : table_.angles()) {
      Reading reading;
      reading.number = static_cast<int>(readings.size());
      reading.wavelength_nm = table_.wavelength_nm(line);
      const double up_deg = is_plane ? angle.deg : 0, turn_deg = is_plane ? 0 : angle.deg;
      const double zenith_deg = sun.zenith / kRadiansPerDegree - up_deg;  // < 0: beyond the zenith
      reading.view_zenith_deg = std::abs(zenith_deg);
      reading.view_azimuth_deg =
          sun.azimuth.value_or(0) / kRadiansPerDegree + (zenith_deg < 0 ? 180 : turn_deg);
      const std::optional<double> value = table_.radiance(line, angle);
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

  void place_in_scan(const AeronetLine& line, const std::string& type, const ScanSun& sun) {
    constexpr std::chrono::minutes kLongestPause{15};
    const double nm = table_.wavelength_nm(line);
    const std::string site = table_.site(line);
    const bool goes_on = last_ && *sun.time - *last_ <= kLongestPause && *sun.time >= *last_ &&
                         type == type_ && site == site_ && !wavelengths_.contains(nm);
    if (!goes_on) {
      sky_.begin_scan(fmt::format("{} of {}", type, iso_text(*sun.time)), sun);
      wavelengths_.clear();
    }
    wavelengths_.insert(nm);
    sky_.move_sun(sun);
    last_ = sun.time;
    type_ = type;
    site_ = site;
  }

  const AeronetTable& table_;
  std::string source_;
  const ImportOptions& options_;
  MeasuredSky& sky_;
  std::set<double> wavelengths_;  // of the scan
  std::optional<Instant> last_;
  std::string type_, site_;
};

}  // namespace

bool is_aeronet_csv(std::string_view text) { return AeronetTable::is_in(text); }

Reference parse_aeronet_csv(std::string_view text, std::string_view source,
                            const ImportOptions& options) {
  const AeronetTable table(text, source);
  ScanHeader layout;
  layout.facts.unit = kUnit;
  ImportOptions facts = options;
  facts.azimuth_zero.reset();  // azimuths count from the sun
  facts.azimuth_turns.reset();
  MeasuredSky sky(std::string(source),
                  stated_unit(layout, options, source, {Quantity::kSpectralRadiance}), facts);
  ScanBuilder builder(table, source, options, sky);
  LeftOut left_out("line");
  for (const AeronetLine& line : table.lines()) left_out.attempt([&] { builder.add(line); });
  for (const std::string& note : left_out.notes()) sky.note(note);
  return sky.finish();
}

}  // namespace skyfit::refs
