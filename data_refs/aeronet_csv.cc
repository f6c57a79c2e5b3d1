// SPDX-License-Identifier: Apache-2.0
#include "data_refs/aeronet_csv.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <numbers>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "data_refs/csv.h"
#include "data_refs/measured_sky.h"
#include "data_refs/scan_header.h"

namespace skyfit::refs {
namespace {

constexpr double kMissing = -999;
constexpr std::string_view kUnit = "uW cm-2 sr-1 nm-1";
constexpr std::string_view kNominal = "Nominal_Wavelength", kExact = "Exact_Wavelength",
                           kTime = "Time", kSunZenith = "Solar_Zenith_Angle",
                           kType = "Sky_Scan_Type", kLatitude = "Latitude",
                           kLongitude = "Longitude", kElevation = "Elevation", kDate = "Date";

struct AngleColumn {
  std::size_t index;
  double azimuth_deg;  // from the sun
};

// The azimuth that a column's name holds, if it is one of radiances.
std::optional<double> azimuth_of(const std::string& column) {
  static const std::regex named(R"(Radiance_for_Azimuth_Angle.*_(-?\d+\.?\d*))");
  std::smatch match;
  return csv_number(std::regex_match(column, match, named) ? match[1].str() : column);
}

bool is_header(std::string_view line) {
  return line.find(kNominal) != line.npos && line.find(kSunZenith) != line.npos;
}

// "Elevation" of "Elevation(m)".
std::string_view without_unit(std::string_view column) {
  return column.substr(0, column.find('('));
}

struct Line {
  int number;
  std::vector<std::string> fields;
};

class AeronetReader {
 public:
  AeronetReader(std::string_view text, std::string_view source) : source_(source) {
    std::istringstream lines{std::string(text)};
    std::string content;
    for (int number = 1; std::getline(lines, content); ++number) {
      if (columns_.empty()) {
        if (is_header(content)) read_columns(csv_fields(content, source_, number), number);
      } else if (content.find_first_not_of(" \t\r,") != content.npos) {
        read_line({number, csv_fields(content, source_, number)});
      }
    }
  }

  const std::vector<Line>& lines() const { return lines_; }
  const std::vector<AngleColumn>& angles() const { return angles_; }
  std::string place(const Line& line) const { return fmt::format("{}:{}", source_, line.number); }

  std::optional<std::size_t> column(std::string_view name) const {
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (without_unit(columns_[i]) == name) return i;
    }
    return {};
  }

  // Of a column that may be missing; so may its value.
  std::optional<double> number(const Line& line, std::string_view name) const {
    const auto index = column(name);
    if (!index) return {};
    const double value = number(line, *index);
    return value == kMissing ? std::nullopt : std::optional(value);
  }

  double number(const Line& line, std::size_t index) const {
    const std::optional<double> value = csv_number(line.fields[index]);
    if (!value) fail(line, index, "a number, -999 where there is none");
    return *value;
  }

  // The exact one where the file has it.
  double wavelength_nm(const Line& line) const {
    const double exact_um = number(line, kExact).value_or(0);
    const double nm = exact_um > 0 ? 1000 * exact_um : number(line, *column(kNominal));
    if (!(nm > 0)) fail(line, *column(kNominal), "a wavelength in nm");
    return nm;
  }

  Instant time(const Line& line) const {
    const std::size_t clock = *column(kTime), date = *column(kDate);
    static const std::regex day_first(R"((\d{1,2})[:/.-](\d{1,2})[:/.-](\d{4}))");
    std::smatch match;
    if (!std::regex_match(line.fields[date], match, day_first)) fail(line, date, "dd:mm:yyyy");
    const auto time =
        instant(fmt::format("{}-{}-{}", match[3].str(), match[2].str(), match[1].str()),
                line.fields[clock], 0);
    if (!time) fail(line, clock, "hh:mm:ss of a day that exists");
    return *time;
  }

 private:
  [[noreturn]] void fail(const Line& line, std::size_t index, std::string_view expectation) const {
    fail_at(
        source_, line.number,
        fmt::format("{} = \"{}\": expected {}", columns_[index], line.fields[index], expectation));
  }

  void read_columns(std::vector<std::string> columns, int number) {
    columns_ = std::move(columns);
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (const auto azimuth = azimuth_of(columns_[i])) angles_.push_back({i, *azimuth});
    }
    for (const std::string_view name : {kDate, kTime, kNominal, kSunZenith, kType}) {
      if (!column(name)) fail_at(source_, number, fmt::format("expected a column {}", name));
    }
    if (angles_.empty())
      fail_at(source_, number, "expected columns of radiances, named by their azimuth");
  }

  void read_line(Line line) {
    if (line.fields.size() < columns_.size()) {
      fail_at(source_, line.number,
              fmt::format("expected {} fields, got {}", columns_.size(), line.fields.size()));
    }
    const std::size_t type = *column(kType);
    if (line.fields[type] != "Almucantar") fail(line, type, "Almucantar");
    lines_.push_back(std::move(line));
  }

  std::string source_;
  std::vector<std::string> columns_;
  std::vector<AngleColumn> angles_;
  std::vector<Line> lines_;
};

ScanSun sun_of_line(const AeronetReader& reader, const Line& line, const ImportOptions& options) {
  ImportOptions in_file;
  in_file.local_time = iso_text(reader.time(line)).substr(0, 19);
  in_file.utc_offset_h = 0;
  in_file.latitude_deg = reader.number(line, kLatitude);
  in_file.longitude_deg = reader.number(line, kLongitude);
  in_file.elevation_m = reader.number(line, kElevation);
  in_file.sun_zenith_deg = reader.number(line, kSunZenith);
  return sun_of_scan(overlaid(options, in_file), reader.place(line), false);
}

void add_line(const AeronetReader& reader, const Line& line, const ScanSun& sun, MeasuredSky& sky) {
  constexpr double kDegree = std::numbers::pi / 180;
  Reading reading;
  reading.view_zenith_deg = sun.zenith / kDegree;
  reading.wavelength_nm = reader.wavelength_nm(line);
  for (const AngleColumn& angle : reader.angles()) {
    reading.view_azimuth_deg = sun.azimuth.value_or(0) / kDegree + angle.azimuth_deg;
    reading.value = reader.number(line, angle.index);
    reading.flaw = reading.value == kMissing ? "missing" : "";
    sky.add(reading);
    ++reading.number;
  }
}

}  // namespace

bool is_aeronet_csv(std::string_view text) {
  const std::size_t header = text.find(kNominal);
  return header != text.npos && text.find(kSunZenith, header) != text.npos;
}

Reference parse_aeronet_csv(std::string_view text, std::string_view source,
                            const ImportOptions& options) {
  constexpr std::chrono::minutes kLongestPause{15};
  const AeronetReader reader(text, source);
  ScanHeader layout;
  layout.facts.unit = kUnit;
  ImportOptions facts = options;
  facts.azimuth_zero.reset();  // azimuths count from the sun
  facts.azimuth_turns.reset();
  if (!reader.lines().empty() && !facts.elevation_m)
    facts.elevation_m = reader.number(reader.lines().front(), kElevation);
  MeasuredSky sky(std::string(source),
                  stated_unit(layout, options, source, {Quantity::kSpectralRadiance}), facts);
  std::set<double> wavelengths;  // of the scan
  std::optional<Instant> last;
  for (const Line& line : reader.lines()) {
    const ScanSun sun = sun_of_line(reader, line, options);
    const bool repeats = !wavelengths.insert(reader.wavelength_nm(line)).second;
    if (!last || repeats || *sun.time - *last > kLongestPause) {
      sky.begin_scan("almucantar of " + iso_text(*sun.time), sun);
      wavelengths = {reader.wavelength_nm(line)};
    }
    sky.move_sun(sun);
    last = sun.time;
    add_line(reader, line, sun, sky);
  }
  return sky.finish();
}

}  // namespace skyfit::refs
