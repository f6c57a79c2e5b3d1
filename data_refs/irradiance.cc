// SPDX-License-Identifier: Apache-2.0
#include "data_refs/irradiance.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "data_refs/closure.h"
#include "data_refs/csv.h"
#include "data_refs/measured_sky.h"
#include "data_refs/other_formats.h"
#include "data_refs/scan_header.h"
#include "data_refs/weather_file.h"
#include "model/base/input_file.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kWater = "precipitable_water", kTime = "time",
                           kSunZenith = "sun_zenith_deg", kWaterColumn = "precipitable_water_mm",
                           kAltitude = "altitude_m", kSigma = "_sigma";

// `most` is above what broken clouds and the sun give together.
struct UnitRow {
  std::string_view name, column;
  Quantity quantity;
  double most;
};
constexpr std::array<UnitRow, 2> kUnits = {
    {{"lx", "lx", Quantity::kIlluminance, 2e5}, {"W/m2", "w_m2", Quantity::kIrradiance, 2000}}};

// What may stand behind a number of the command line.
struct Spelling {
  std::string_view text;
  const UnitRow& unit;
  double factor;
};
constexpr std::array<Spelling, 4> kSpellings = {{{"klx", kUnits[0], 1e3},
                                                 {"lx", kUnits[0], 1},
                                                 {"W/m2", kUnits[1], 1},
                                                 {"W/m^2", kUnits[1], 1}}};

struct ShortName {
  std::string_view name;
  Irradiance what;
};
constexpr std::array<ShortName, 3> kShortNames = {
    {{"direct", kDirectNormal}, {"diffuse", kDiffuseHorizontal}, {"global", kGlobalHorizontal}}};

std::optional<Irradiance> irradiance_named(std::string_view name) {
  for (const ShortName& row : kShortNames) {
    if (row.name == name) return row.what;
  }
  const auto at = std::ranges::find(kIrradianceNames, name);
  if (at == kIrradianceNames.end()) return {};
  return static_cast<Irradiance>(at - kIrradianceNames.begin());
}

struct Measured {
  std::optional<double> value, sigma;
};

// What was measured under one sun.
struct Row {
  std::array<Measured, kIrradianceCount> of;
  std::optional<double> water_mm;
};

[[noreturn]] void fail(std::string_view place, std::string_view message) {
  throw std::invalid_argument(fmt::format("{}: {}", place, message));
}

// The references of all three sources.
class Irradiances {
 public:
  Irradiances(std::string name, const UnitRow& unit) : unit_(unit) {
    reference_.name = std::move(name);
    reference_.quantity = unit.quantity;
  }

  // `place` begins messages.
  void add(const Row& row, const ScanSun& sun, const std::string& place) {
    check(row, place);
    const int scan = static_cast<int>(reference_.scans.size());
    Scan info;
    info.name = sun.time ? iso_text(*sun.time)
                         : fmt::format("sun zenith {:.6g} deg", sun.zenith * kDegreesPerRadian);
    if (sun.time) info.time_utc = iso_text(*sun.time);
    info.sun_azimuth = sun.azimuth;
    info.sun_distance_au = sun.distance_au;
    info.elevation_m = sun.elevation_m;
    info.site = sun.site;
    info.precipitable_water_mm = row.water_mm;
    reference_.scans.push_back(info);
    for (int i = 0; i < kIrradianceCount; ++i) {
      const Measured& measured = row.of[static_cast<std::size_t>(i)];
      if (measured.value) add_sample(static_cast<Irradiance>(i), measured, sun.zenith, scan);
    }
    if (!sun.remark.empty()) note(place + ": " + sun.remark);
    check_closure(row, sun.zenith, place);
  }

  void note(std::string text) { reference_.notes.push_back(std::move(text)); }

  Reference finish() {
    reference_.description = fmt::format(
        "{} of {} sun{}", unit_.quantity == Quantity::kIlluminance ? "illuminances" : "irradiances",
        reference_.scans.size(), reference_.scans.size() == 1 ? "" : "s");
    if (unit_.quantity == Quantity::kIrradiance) {
      note(
          "the model has no water vapour, carbon dioxide and oxygen: their absorption is that of "
          "SPECTRL2 (Bird & Riordan 1984), good to 2 % of the beam; illuminances need none of it");
    }
    return std::move(reference_);
  }

 private:
  void check(const Row& row, const std::string& place) const {
    if (std::ranges::none_of(row.of, [](const Measured& m) { return m.value.has_value(); }))
      fail(place,
           fmt::format("no irradiance, expected one of {}", fmt::join(kIrradianceNames, ", ")));
    for (int i = 0; i < kIrradianceCount; ++i) {
      const auto& [value, sigma] = row.of[static_cast<std::size_t>(i)];
      const std::string_view name = kIrradianceNames[static_cast<std::size_t>(i)];
      if (value && !(std::isfinite(*value) && *value <= unit_.most))
        fail(place, fmt::format("{} = {:.9g} {}: expected at most {:.6g}", name, *value, unit_.name,
                                unit_.most));
      if (sigma && !(std::isfinite(*sigma) && *sigma > 0))
        fail(place, fmt::format("{}: sigma = {:.9g}: expected a number > 0", name, *sigma));
    }
    constexpr double kMostWater_mm = 100;
    if (row.water_mm && !(*row.water_mm > 0 && *row.water_mm <= kMostWater_mm)) {
      fail(place, fmt::format("{} = {:.9g} mm: expected more than 0, at most {:g}", kWater,
                              *row.water_mm, kMostWater_mm));
    }
    if (unit_.quantity == Quantity::kIrradiance && !row.water_mm) {
      fail(place, fmt::format("{}: not known, expected the column of water vapour in mm beside "
                              "W/m2, of which it absorbs a tenth (lx need none), such as {}=14mm",
                              kWater, kWater));
    }
  }

  void add_sample(Irradiance what, const Measured& measured, double sun_zenith, int scan) {
    Sample sample;
    sample.irradiance = what;
    sample.sun_zenith = sun_zenith;
    sample.view_zenith = what == kDirectNormal ? sun_zenith : 0;
    sample.value = *measured.value;
    sample.sigma = measured.sigma;
    sample.scan = scan;
    if (!(sample.value > 0)) {
      sample.weight = 0;
      sample.zero_weight_reason = "not positive";
    }
    reference_.samples.push_back(sample);
  }

  // Whether beam and sky make the sum, within what the Baseline Surface Radiation Network asks for
  // (Long & Shi 2008, Open Atmos. Sci. J. 2, 23: 8 %, below a sun of 75 deg 15 %).
  void check_closure(const Row& row, double sun_zenith, const std::string& place) {
    const Measured &normal = row.of[kDirectNormal], &horizontal = row.of[kDirectHorizontal],
                   &diffuse = row.of[kDiffuseHorizontal], &global = row.of[kGlobalHorizontal];
    if (!diffuse.value || !global.value || (!normal.value && !horizontal.value)) return;
    const double direct = normal.value ? *normal.value * std::cos(sun_zenith) : *horizontal.value;
    const double off = closure(*global.value, direct, *diffuse.value) - 1,
                 most = sun_zenith < kHighSun ? 0.08 : 0.15;
    if (std::abs(off) <= most) return;
    const bool another = std::abs(off) > kAnotherSun && sun_zenith < kHighSun;
    const std::string message = fmt::format(
        "global_horizontal is {:.3g} times direct and diffuse together under a sun {:.1f} deg from "
        "the zenith, expected within {:.2g} of 1: sun, time or levelling may be wrong",
        1 + off, sun_zenith * kDegreesPerRadian, another ? kAnotherSun : most);
    if (another) fail(place, message);
    note(place + ": " + message);
  }

  const UnitRow& unit_;
  Reference reference_;
};

// Of "83000:500lx", the numbers before the unit.
Measured measured_of(std::string_view part, std::string_view numbers, double factor) {
  const std::size_t colon = numbers.find(':');
  const auto number = [&](std::string_view text) {
    const std::optional<double> value = csv_number(trim(text));
    if (!value || !std::isfinite(*value))
      fail(part, "expected NAME=VALUE[:SIGMA]UNIT, such as direct_normal=83000:1500lx");
    return factor * *value;
  };
  Measured measured{number(numbers.substr(0, colon)), {}};
  if (colon != std::string_view::npos) measured.sigma = number(numbers.substr(colon + 1));
  return measured;
}

double water_of(std::string_view part, std::string_view value) {
  const std::optional<double> water =
      value.ends_with("mm") ? csv_number(value.substr(0, value.size() - 2)) : std::nullopt;
  if (!water) fail(part, fmt::format("expected {}=NUMBERmm, such as {}=14mm", kWater, kWater));
  return *water;
}

// NAME=VALUE[:SIGMA]UNIT; sets the unit, which all share.
void read_value(const std::string& part, Row& row, const UnitRow*& unit) {
  const std::size_t equals = part.find('=');
  if (equals == std::string::npos)
    fail(part, "expected NAME=VALUE[:SIGMA]UNIT, such as direct_normal=83000lx");
  const std::string_view name = trim(std::string_view(part).substr(0, equals)),
                         value = trim(std::string_view(part).substr(equals + 1));
  if (name == kWater) {
    row.water_mm = water_of(part, value);
    return;
  }
  const std::optional<Irradiance> what = irradiance_named(name);
  if (!what) {
    fail(part, fmt::format("expected one of {}, {}", fmt::join(kIrradianceNames, ", "), kWater));
  }
  const auto its =
      std::ranges::find_if(kSpellings, [&](const Spelling& s) { return value.ends_with(s.text); });
  if (its == kSpellings.end()) {
    fail(part,
         "no unit, expected lx or klx (an illuminance) or W/m2 (of all wavelengths) behind the "
         "number");
  }
  if (unit != nullptr && unit != &its->unit)
    fail(part, fmt::format("expected {} as before: one unit for all", unit->name));
  unit = &its->unit;
  Measured& measured = row.of[static_cast<std::size_t>(*what)];
  if (measured.value) fail(part, "is given twice");
  measured = measured_of(part, value.substr(0, value.size() - its->text.size()), its->factor);
  if (!(*measured.value > 0)) fail(part, "expected a value > 0");
}

Reference of_values(std::string_view text, std::optional<double> sun_zenith,
                    const ImportOptions& options) {
  Row row;
  const UnitRow* unit = nullptr;
  for (const std::string_view part : split(text, ','))
    read_value(std::string(trim(part)), row, unit);
  if (unit == nullptr)
    fail(text, fmt::format("no irradiance, expected one of {}", fmt::join(kIrradianceNames, ", ")));
  ImportOptions facts = options;
  const bool has_site = options.local_time && options.latitude_deg && options.longitude_deg;
  if (!sun_zenith && !has_site) {
    fail("irradiances",
         "the sun is not known: expected sun_zenith_deg, or local_time, latitude_deg and "
         "longitude_deg");
  }
  if (!has_site) facts.sun_zenith_deg = *sun_zenith * kDegreesPerRadian;
  Irradiances irradiances("irradiances", *unit);
  irradiances.add(row, sun_of_scan(facts, "irradiances", false), "irradiances");
  return irradiances.finish();
}

Reference of_weather(std::string_view text) {
  const std::size_t comma = text.find(',', text.rfind('@'));
  const std::string file_and_time(text.substr(0, comma));
  Row row;
  if (comma != std::string_view::npos) {
    const std::string part(trim(text.substr(comma + 1)));
    const std::string_view value = part;
    if (!value.starts_with(kWater) || part.find('=') != kWater.size())
      fail(part, fmt::format("expected {}=NUMBERmm behind a weather file", kWater));
    row.water_mm = water_of(part, value.substr(kWater.size() + 1));
  }
  const WeatherHour hour = weather_hour(file_and_time);
  row.of[kDirectNormal].value = hour.direct_normal_w_m2;
  row.of[kDiffuseHorizontal].value = hour.diffuse_horizontal_w_m2;
  if (!row.water_mm) row.water_mm = hour.precipitable_water_mm;
  const SolarPosition position = solar_position(hour.middle, hour.site);
  if (!(position.zenith < 0.5 * std::numbers::pi)) {
    fail(file_and_time, fmt::format("the sun is {:.2f} deg from the zenith: expected less than 90",
                                    position.zenith * kDegreesPerRadian));
  }
  ScanSun sun;
  sun.zenith = position.zenith;
  sun.azimuth = position.azimuth;
  sun.distance_au = position.distance_au;
  sun.time = hour.middle;
  sun.elevation_m = hour.site.elevation_m;
  sun.site = hour.site;
  Irradiances irradiances(file_and_time, kUnits[1]);
  irradiances.add(row, sun, file_and_time);
  return irradiances.finish();
}

CsvTable table_of(const std::string& text, const std::string& file) {
  try {
    return CsvTable(text, file);
  } catch (const std::invalid_argument&) {
    if (const auto other = other_format(text)) fail(file, *other);
    throw;
  }
}

// The unit whose columns the table has.
const UnitRow& unit_of(const CsvTable& table) {
  const UnitRow* found = nullptr;
  for (const UnitRow& unit : kUnits) {
    for (const std::string_view name : kIrradianceNames) {
      if (!table.has(fmt::format("{}_{}", name, unit.column))) continue;
      if (found != nullptr && found != &unit)
        table.fail_header("columns in lx and in W/m2: expected one unit for all");
      found = &unit;
    }
  }
  if (found == nullptr) {
    table.fail_header(fmt::format("expected a column NAME_lx or NAME_w_m2, NAME one of {}",
                                  fmt::join(kIrradianceNames, ", ")));
  }
  return *found;
}

std::vector<std::string> known_columns(const UnitRow& unit) {
  std::vector<std::string> names = {std::string(kTime), std::string(kSunZenith),
                                    std::string(kWaterColumn), std::string(kAltitude)};
  for (const std::string_view name : kIrradianceNames) {
    names.push_back(fmt::format("{}_{}", name, unit.column));
    names.push_back(names.back() + std::string(kSigma));
  }
  return names;
}

void expect_known_columns(const CsvTable& table, const UnitRow& unit) {
  const std::vector<std::string> known = known_columns(unit);
  for (const std::string& column : table.columns()) {
    if (std::ranges::find(known, column) != known.end()) continue;
    table.fail_header(fmt::format("{}: unknown column, expected one of {}", excerpt(column),
                                  fmt::join(known, ", ")));
  }
}

std::optional<double> field_of(const CsvTable& table, const CsvRecord& record,
                               const std::string& column) {
  if (!table.has(column) || table.text(record, column).empty()) return {};
  return table.number(record, column);
}

Row row_of(const CsvTable& table, const CsvRecord& record, const UnitRow& unit) {
  Row row;
  for (std::size_t i = 0; i < kIrradianceNames.size(); ++i) {
    const std::string column = fmt::format("{}_{}", kIrradianceNames[i], unit.column);
    row.of[i] = {field_of(table, record, column),
                 field_of(table, record, column + std::string(kSigma))};
  }
  row.water_mm = field_of(table, record, std::string(kWaterColumn));
  return row;
}

Reference of_csv(const std::string& file, const ImportOptions& options) {
  const std::string text = read_text_file(file, "a table of irradiances");
  const CsvTable table = table_of(text, file);
  const UnitRow& unit = unit_of(table);
  expect_known_columns(table, unit);
  const ImportOptions facts = overlaid(options, scan_header(text, file).facts);
  if (!table.has(kSunZenith) && !table.has(kTime))
    table.fail_header(fmt::format("expected a column {} or {}", kSunZenith, kTime));
  Irradiances irradiances(file, unit);
  LeftOut left_out("line");
  for (const CsvRecord& record : table.records()) {
    const std::string place = fmt::format("{}:{}", file, record.line);
    left_out.attempt([&] {
      ImportOptions of_line = facts;
      if (table.has(kTime)) of_line.local_time = table.text(record, kTime);
      if (table.has(kSunZenith)) of_line.sun_zenith_deg = table.number(record, kSunZenith);
      if (table.has(kAltitude)) of_line.elevation_m = table.number(record, kAltitude);
      irradiances.add(row_of(table, record, unit), sun_of_scan(of_line, place, false), place);
    });
  }
  if (table.records().empty()) fail(file, "no line, expected at least one");
  for (const std::string& note : left_out.notes()) irradiances.note(note);
  return irradiances.finish();
}

}  // namespace

Reference irradiance_reference(std::string_view text, std::optional<double> sun_zenith,
                               const ImportOptions& options) {
  validate(options);
  if (text.find('@') != std::string_view::npos) return of_weather(text);
  if (text.find('=') != std::string_view::npos) return of_values(text, sun_zenith, options);
  return of_csv(std::string(text), options);
}

Reference irradiance_table(const std::filesystem::path& file, const ImportOptions& options) {
  validate(options);
  return of_csv(file.string(), options);
}

}  // namespace skyfit::refs
