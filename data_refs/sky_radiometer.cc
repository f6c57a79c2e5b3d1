// SPDX-License-Identifier: Apache-2.0
#include "data_refs/sky_radiometer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "data_refs/csv.h"
#include "data_refs/photometer_scans.h"
#include "data_refs/pom_instrument.h"
#include "data_refs/spectra.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"
#include "model/photometry/photometry.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kUnit = "W m-2 sr-1 nm-1";
constexpr std::size_t kFirstCurrent = 4;  // fields before it

struct Direction {
  double azimuth_deg, height_deg;
  std::vector<double> current_a;
};

struct RawScan {
  int line;  // of its header
  std::vector<std::string> header;
  std::vector<std::pair<int, std::vector<std::string>>> rows;  // with their lines
};

class PomFile {
 public:
  PomFile(std::string_view text, std::string_view source) : source_(source) {
    std::istringstream lines{std::string(text)};
    std::string content;
    for (int line = 1; std::getline(lines, content); ++line) {
      if (trim(content).empty()) continue;
      std::vector<std::string> fields = csv_fields(content, source_, line);
      if (header_.empty()) {
        read_header(fields, line);
      } else if (wavelength_nm_.empty()) {
        read_channels(fields, line);
      } else if (fields.front().find('/') != std::string::npos) {
        scans_.push_back({line, std::move(fields), {}});
      } else if (scans_.empty()) {
        fail_at(source_, line, "expected the header of a scan, YY/MM/DD,HH:MM:SS,..");
      } else {
        scans_.back().rows.emplace_back(line, std::move(fields));
      }
    }
    if (scans_.empty())
      throw std::invalid_argument(fmt::format("{}: 0 scans: expected at least 1", source_));
  }

  const std::vector<RawScan>& scans() const { return scans_; }
  const std::vector<double>& wavelength_nm() const { return wavelength_nm_; }

  // The file's and the instrument's must be the same.
  void expect(const PomInstrument& instrument, std::string_view file) const {
    constexpr double kSameWavelength_nm = 1;  // as in SKYRAD.pack
    constexpr std::string_view kNone = "0000000";
    const std::string& sensor = header_[2];
    if (sensor != instrument.number && !sensor.ends_with(kNone)) {
      throw std::invalid_argument(fmt::format("{}: instrument {}: expected {}, as {} has", file,
                                              in_quotes(instrument.number), in_quotes(sensor),
                                              source_));
    }
    const bool same =
        std::ranges::equal(wavelength_nm_, instrument.wavelength_nm,
                           [](double a, double b) { return std::abs(a - b) < kSameWavelength_nm; });
    if (!same) {
      throw std::invalid_argument(fmt::format(
          "{}: wavelengths {:g} nm: expected {:g} nm, as {} has", file,
          fmt::join(instrument.wavelength_nm, ", "), fmt::join(wavelength_nm_, ", "), source_));
    }
  }

  // Time and place of a scan.
  ImportOptions facts(const RawScan& scan) const {
    constexpr std::size_t kFields = 5;
    if (scan.header.size() < kFields)
      fail_at(source_, scan.line,
              fmt::format("expected at least {} fields, got {}", kFields, scan.header.size()));
    const std::string& date = scan.header[0];
    const bool is_short = date.find('/') == 2;  // of a year from 2000 on
    const auto time = instant(is_short ? "20" + date : date, scan.header[1], 0);
    if (!time)
      fail_at(source_, scan.line,
              fmt::format("date and time UTC = \"{},{}\": expected YY/MM/DD,HH:MM:SS", date,
                          scan.header[1]));
    ImportOptions facts = place_;
    facts.local_time = iso_text(*time).substr(0, 19);
    facts.utc_offset_h = 0;
    return facts;
  }

  std::vector<Direction> directions(const RawScan& scan) const {
    std::vector<Direction> directions;
    for (const auto& [line, fields] : scan.rows) {
      const std::size_t needed = kFirstCurrent + wavelength_nm_.size();
      if (fields.size() < needed)
        fail_at(source_, line,
                fmt::format("expected at least {} fields, got {}", needed, fields.size()));
      Direction direction{
          number(fields[2], "azimuth", line), number(fields[3], "height", line), {}};
      for (std::size_t i = kFirstCurrent; i < needed; ++i)
        direction.current_a.push_back(number(fields[i], "current", line));
      directions.push_back(std::move(direction));
    }
    if (directions.size() < 2)
      fail_at(source_, scan.line,
              fmt::format("{} directions: expected the sun and at least one of the sky",
                          directions.size()));
    return directions;
  }

 private:
  double number(const std::string& field, std::string_view name, int line) const {
    const std::optional<double> value = csv_number(field);
    if (value && std::isfinite(*value)) return *value;
    fail_at(source_, line, fmt::format("{} = {}: expected a number", name, in_quotes(field)));
  }

  void read_header(const std::vector<std::string>& fields, int line) {
    constexpr std::size_t kFields = 9;
    if (fields.size() < kFields)
      fail_at(source_, line, fmt::format("expected {} fields, got {}", kFields, fields.size()));
    header_ = fields;
    place_.longitude_deg = number(fields[3], "longitude", line);
    place_.latitude_deg = number(fields[4], "latitude", line);
    if (std::abs(*place_.longitude_deg) > 360)
      fail_at(source_, line, "longitude = " + fields[3] + ": expected -360 to 360");
    if (std::abs(*place_.latitude_deg) > 90)
      fail_at(source_, line, "latitude = " + fields[4] + ": expected -90 to 90");
  }

  void read_channels(const std::vector<std::string>& fields, int line) {
    const double channels = number(fields[0], "number of channels", line);
    if (channels < 1 || channels != static_cast<double>(fields.size() - 1))
      fail_at(source_, line,
              fmt::format("number of channels = {:g}: expected that of the {} "
                          "wavelengths behind it",
                          channels, fields.size() - 1));
    for (std::size_t i = 1; i < fields.size(); ++i)
      wavelength_nm_.push_back(number(fields[i], "wavelength in nm", line));
  }

  std::string source_;
  std::vector<std::string> header_;
  ImportOptions place_;
  std::vector<double> wavelength_nm_;
  std::vector<RawScan> scans_;
};

ScanPath path_of(const RawScan& scan, std::string_view source) {
  const std::string& type = scan.header[4];
  if (type == "H") return ScanPath::kAlmucantar;
  if (type == "V") return ScanPath::kPrincipalPlane;
  fail_at(source, scan.line,
          fmt::format("scan type = {}: expected H or V, a scan of the sky", in_quotes(type)));
}

// How far the first direction is from the sun, degrees.
double off_sun_deg(const Direction& first, const ScanSun& sun) {
  constexpr double kSouth_deg = 180;
  Sample between;  // the angle between two suns, as that between sun and view
  between.sun_zenith = sun.zenith;
  between.view_zenith = (90 - first.height_deg) * kRadiansPerDegree;
  between.relative_azimuth =
      (first.azimuth_deg + kSouth_deg) * kRadiansPerDegree - sun.azimuth.value_or(0);
  return scattering_angle(between) / kRadiansPerDegree;
}

class Calibrated {
 public:
  Calibrated(const PomFile& file, const PomInstrument& instrument, std::string_view source)
      : file_(file), instrument_(instrument), source_(source) {}

  // One line a channel; the sun is that of the scan's begin.
  std::vector<PhotometerLine> lines(const RawScan& scan, const ImportOptions& options) {
    const ImportOptions facts = file_.facts(scan);
    const ScanPath path = path_of(scan, source_);
    const std::vector<Direction> directions = file_.directions(scan);
    const std::string place = fmt::format("{}:{}", source_, scan.line);
    const ScanSun sun = sun_of_scan(overlaid(options, facts), place);
    expect_sun(directions.front(), sun, place);
    std::vector<PhotometerLine> lines;
    for (std::size_t channel = 0; channel < file_.wavelength_nm().size(); ++channel) {
      PhotometerLine line{place, path, {}, file_.wavelength_nm()[channel], facts, {}};
      const std::optional<double> factor = radiance_per_ampere(channel, *sun.time);
      for (const Direction& direction : directions) {
        PhotometerReading reading{direction.height_deg - directions.front().height_deg,
                                  direction.azimuth_deg - directions.front().azimuth_deg,
                                  direction.current_a[channel] * factor.value_or(0)};
        if (!factor) reading.flaw = "channel without calibration";
        if (&direction == &directions.front()) reading.flaw = "the sun itself";
        line.readings.push_back(std::move(reading));
      }
      lines.push_back(std::move(line));
    }
    return lines;
  }

  double most_off_sun_deg() const { return most_off_sun_deg_; }

 private:
  void expect_sun(const Direction& first, const ScanSun& sun, const std::string& place) {
    constexpr double kMost_deg = 5;  // of an axis that is not upright; an hour's sun is 15 deg
    const double off_deg = off_sun_deg(first, sun);
    if (off_deg > kMost_deg) {
      throw std::invalid_argument(fmt::format(
          "{}: the first direction, azimuth {:g} and height {:g} deg, is {:.1f} deg away from the "
          "sun of {}: expected the sun within {} deg",
          place, first.azimuth_deg, first.height_deg, off_deg, iso_text(*sun.time), kMost_deg));
    }
    most_off_sun_deg_ = std::max(most_off_sun_deg_, off_deg);
  }

  std::optional<double> radiance_per_ampere(std::size_t channel, Instant time) const {
    const std::optional<double> sun_a = instrument_.current_a(channel, time);
    if (!sun_a) return std::nullopt;
    return standard_spectral_data().solar_irradiance.at(file_.wavelength_nm()[channel]) /
           (*sun_a * instrument_.solid_angle_sr[channel]);
  }

  const PomFile& file_;
  const PomInstrument& instrument_;
  std::string source_;
  double most_off_sun_deg_ = 0;
};

}  // namespace

bool is_sky_radiometer(std::string_view first_line) { return first_line.starts_with("POM-0"); }

Reference parse_sky_radiometer(std::string_view text, std::string_view source,
                               const ImportOptions& options) {
  if (!options.instrument_parameters) {
    throw std::invalid_argument(
        fmt::format("{}: instrument_parameters: not stated, expected the ins.para of SKYRAD.pack "
                    "with the calibration of its currents",
                    source));
  }
  const PomFile file(text, source);
  const PomInstrument instrument = load_pom_instrument(*options.instrument_parameters);
  file.expect(instrument, *options.instrument_parameters);
  MeasuredSky sky = photometer_sky(source, options, kUnit);
  PhotometerScans scans(options, sky);
  Calibrated calibrated(file, instrument, source);
  LeftOut left_out("scan");
  for (const RawScan& scan : file.scans()) {
    left_out.attempt([&] {
      for (const PhotometerLine& line : calibrated.lines(scan, options)) scans.add(line);
    });
  }
  for (const std::string& note : left_out.notes()) sky.note(note);
  sky.note(
      fmt::format("directions count from the first of each scan, which is up to {:.1f} deg away "
                  "from the computed sun",
                  calibrated.most_off_sun_deg()));
  return sky.finish();
}

}  // namespace skyfit::refs
