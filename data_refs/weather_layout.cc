// SPDX-License-Identifier: Apache-2.0
#include "data_refs/weather_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "data_refs/csv.h"
#include "model/base/pattern.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

std::vector<std::string> words_of(std::string_view line, std::string_view = {}, int = 0) {
  std::istringstream in{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> comma_fields(std::string_view line, std::string_view source, int number) {
  return csv_fields(line, source, number);
}

// Places of columns by the beginnings of their names.
struct Columns {
  std::vector<std::string> names;
  std::string_view source;
  int line;

  std::optional<std::size_t> find(std::string_view name) const {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].starts_with(name)) return i;
    }
    return {};
  }
  std::size_t required(std::string_view name) const {
    if (const auto at = find(name)) return *at;
    fail_at(source, line, fmt::format("expected a column {}", name));
  }
};

// Degrees east and hours ahead of UTC, as files state them.
Site site_of(double latitude_deg, double longitude_deg, double elevation_m, double utc_offset_h,
             std::string_view source) {
  const auto require = [&](const char* name, double value, double low, double high) {
    if (!(value >= low && value <= high))
      throw std::invalid_argument(
          fmt::format("{}: {} = {:.9g}: expected {:g} to {:g}", source, name, value, low, high));
  };
  require("latitude", latitude_deg, -90, 90);
  require("longitude", longitude_deg, -180, 180);
  require("elevation", elevation_m, -500, 9000);
  require("time zone", utc_offset_h, -14, 14);
  return {latitude_deg * kRadiansPerDegree, longitude_deg * kRadiansPerDegree, elevation_m};
}

// Where a line tells the place.
struct PlaceFields {
  std::size_t time_zone, latitude, longitude, elevation;
};

void take_place(const std::vector<std::string>& fields, const PlaceFields& at,
                std::string_view source, int line, WeatherLayout& layout) {
  const auto number = [&](std::size_t i, std::string_view name) {
    return weather_number(fields, i, name, source, line);
  };
  layout.utc_offset_h = number(at.time_zone, "time zone");
  layout.site = site_of(number(at.latitude, "latitude"), number(at.longitude, "longitude"),
                        number(at.elevation, "elevation"), layout.utc_offset_h, source);
}

// Month, day and hour of the fields from `first` on.
WeatherClock clock_of(const std::vector<std::string>& fields, std::size_t first,
                      std::string_view source, int line) {
  return {static_cast<unsigned>(weather_number(fields, first, "month", source, line)),
          static_cast<unsigned>(weather_number(fields, first + 1, "day", source, line)),
          weather_number(fields, first + 2, "hour", source, line)};
}

// The hour is the one that ends, from 1.
WeatherClock epw_clock(const std::vector<std::string>& fields, std::string_view source, int line) {
  const WeatherClock clock = clock_of(fields, 1, source, line);
  if (!(clock.hour >= 1 && clock.hour <= 24))
    fail_at(source, line,
            fmt::format("hour = {:.9g}: expected 1 to 24, the hour that ends", clock.hour));
  return clock;
}

// The minute is the end of the interval in the hour that ends.
WeatherClock epw_clock_with_minute(const std::vector<std::string>& fields, std::string_view source,
                                   int line) {
  WeatherClock clock = epw_clock(fields, source, line);
  clock.hour += weather_number(fields, 4, "minute", source, line) / 60 - 1;
  return clock;
}

// Of WEA the hour of the sun, as gendaymtx takes it; of TMY2 the hour that ends, from 1.
WeatherClock first_fields_clock(const std::vector<std::string>& fields, std::string_view source,
                                int line) {
  return clock_of(fields, 0, source, line);
}

// MM/DD/YYYY and HH:MM, 24:00 for midnight, the end of the interval.
WeatherClock tmy3_clock(const std::vector<std::string>& fields, std::string_view source, int line) {
  unsigned month = 0, day = 0, hour = 0, minute = 0;
  if (fields.size() < 2 || std::sscanf(fields[0].c_str(), "%2u/%2u/", &month, &day) != 2 ||
      std::sscanf(fields[1].c_str(), "%2u:%2u", &hour, &minute) != 2)
    fail_at(source, line, "expected a date MM/DD/YYYY and a time HH:MM");
  return {month, day, hour + minute / 60.0};
}

// Year, month, day, hour and minute of the instant.
WeatherClock nsrdb_clock(const std::vector<std::string>& fields, std::string_view source,
                         int line) {
  WeatherClock clock = clock_of(fields, 1, source, line);
  clock.hour += weather_number(fields, 4, "minute", source, line) / 60;
  return clock;
}

// YYYYMMDD:HHMM.
WeatherClock pvgis_clock(const std::vector<std::string>& fields, std::string_view source,
                         int line) {
  unsigned month = 0, day = 0, hour = 0, minute = 0;
  if (std::sscanf(fields[0].c_str(), "%*4u%2u%2u:%2u%2u", &month, &day, &hour, &minute) != 4)
    fail_at(source, line, fmt::format("time = {}: expected YYYYMMDD:HHMM", in_quotes(fields[0])));
  return {month, day, hour + minute / 60.0};
}

WeatherLayout epw_layout(const std::vector<std::string>& lines, std::string_view source) {
  const std::vector<std::string> fields = csv_fields(lines[0], source, 1);
  WeatherLayout layout{.first_row = 8,
                       .fields = comma_fields,
                       .clock = epw_clock,
                       .direct = 14,
                       .diffuse = 15,
                       .water = 28,
                       .global = 13};
  take_place(fields, {8, 6, 7, 9}, source, 1, layout);
  if (lines.size() > 7) {  // DATA PERIODS, their number, records per hour
    const double records =
        weather_number(csv_fields(lines[7], source, 8), 2, "records per hour", source, 8);
    if (!(records >= 1 && records <= 60))
      fail_at(source, 8, fmt::format("records per hour = {:.9g}: expected 1 to 60", records));
    layout.interval_h = 1 / records;
    if (records > 1) layout.clock = epw_clock_with_minute;
  }
  layout.middle_after_stamp_h = -0.5 * layout.interval_h;
  return layout;
}

// West is positive, and so is the meridian of its time.
WeatherLayout wea_layout(const std::vector<std::string>& lines, std::string_view source) {
  WeatherLayout layout{
      .first_row = 6, .fields = words_of, .clock = first_fields_clock, .direct = 3, .diffuse = 4};
  const auto header = [&](std::size_t line, const std::string& name) {
    const std::vector<std::string> words =
        line < lines.size() ? words_of(lines[line]) : std::vector<std::string>{};
    if (words.empty() || words[0] != name)
      fail_at(source, static_cast<int>(line) + 1, fmt::format("expected a line {}", name));
    return weather_number(words, 1, name, source, static_cast<int>(line) + 1);
  };
  const double latitude = header(1, "latitude"), longitude = -header(2, "longitude");
  const double meridian = header(3, "time_zone");
  if (constexpr double kQuarter = 3.75; std::remainder(meridian, kQuarter) != 0)
    fail_at(source, 4,
            fmt::format("time_zone = {:.9g}: expected the meridian of the clock, degrees west, a "
                        "multiple of {:g}, 15 for an hour",
                        meridian, kQuarter));
  layout.utc_offset_h = -meridian / 15;
  layout.site =
      site_of(latitude, longitude, header(4, "site_elevation"), layout.utc_offset_h, source);
  if (header(5, "weather_data_file_units") != 1)
    fail_at(source, 6, "weather_data_file_units: expected 1, irradiances in W/m^2");
  return layout;
}

WeatherLayout tmy3_layout(const std::vector<std::string>& lines, std::string_view source) {
  const std::vector<std::string> fields = csv_fields(lines[0], source, 1);
  const Columns columns{csv_fields(lines.at(1), source, 2), source, 2};
  WeatherLayout layout{.first_row = 2,
                       .fields = comma_fields,
                       .clock = tmy3_clock,
                       .middle_after_stamp_h = -0.5,
                       .direct = columns.required("DNI ("),
                       .diffuse = columns.required("DHI ("),
                       .water = columns.find("Pwat (cm)"),
                       .global = columns.find("GHI ("),
                       .mm_per_water = 10};
  take_place(fields, {3, 4, 5, 6}, source, 1, layout);
  return layout;
}

// Of TMY2: the time zone, N and degrees and minutes, W and degrees and minutes, the elevation.
const std::regex& tmy2_head() {
  static const std::regex pattern(
      R"(\s(-?\d+)\s+([NS])\s+(\d+)\s+(\d+)\s+([EW])\s+(\d+)\s+(\d+)\s+(-?\d+)\s*$)");
  return pattern;
}

// Of the fixed columns of TMY2: month, day, hour, direct normal, diffuse horizontal, water in mm.
std::vector<std::string> tmy2_fields(std::string_view line, std::string_view, int) {
  struct Places {
    std::size_t first, count;  // the first of a line is 1
  };
  std::vector<std::string> fields;
  for (const auto [first, count] : {Places{4, 2}, {6, 2}, {8, 2}, {24, 4}, {30, 4}, {124, 3}}) {
    if (line.size() < first) break;
    fields.emplace_back(trim(line.substr(first - 1, count)));
  }
  return fields;
}

WeatherLayout tmy2_layout(const std::vector<std::string>& lines, std::string_view source) {
  const std::cmatch head = *first_match(lines[0], tmy2_head());
  const auto degrees = [&](std::size_t side, char negative) {
    const double value = std::stod(head[side + 1]) + std::stod(head[side + 2]) / 60;
    return head[side].str()[0] == negative ? -value : value;
  };
  WeatherLayout layout{.first_row = 1,
                       .fields = tmy2_fields,
                       .clock = first_fields_clock,
                       .middle_after_stamp_h = -0.5,
                       .direct = 3,
                       .diffuse = 4,
                       .water = 5};
  layout.utc_offset_h = std::stod(head[1]);
  layout.site =
      site_of(degrees(2, 'S'), degrees(5, 'W'), std::stod(head[8]), layout.utc_offset_h, source);
  return layout;
}

constexpr std::string_view kNsrdbHead = "Source,Location ID,";

// Names of facts, the facts, the columns of the rows.
WeatherLayout nsrdb_layout(const std::vector<std::string>& lines, std::string_view source) {
  constexpr std::size_t kHeadLines = 3;
  if (lines.size() < kHeadLines)
    fail_at(source, static_cast<int>(lines.size()), "expected a line of columns below the facts");
  const Columns facts{csv_fields(lines[0], source, 1), source, 1},
      columns{csv_fields(lines[2], source, 3), source, 3};
  const std::vector<std::string> values = csv_fields(lines[1], source, 2);
  constexpr std::array<std::string_view, 5> kStamp = {"Year", "Month", "Day", "Hour", "Minute"};
  if (!std::ranges::equal(kStamp.begin(), kStamp.end(), columns.names.begin(),
                          columns.names.begin() + static_cast<std::ptrdiff_t>(std::min(
                                                      kStamp.size(), columns.names.size()))))
    fail_at(source, 3, "expected the columns Year, Month, Day, Hour, Minute, ..");
  WeatherLayout layout{.first_row = kHeadLines,
                       .fields = comma_fields,
                       .clock = nsrdb_clock,
                       .direct = columns.required("DNI"),
                       .diffuse = columns.required("DHI"),
                       .water = columns.find("Precipitable Water"),
                       .global = columns.find("GHI"),
                       .mm_per_water = 10};
  take_place(values,
             {facts.required("Time Zone"), facts.required("Latitude"), facts.required("Longitude"),
              facts.required("Elevation")},
             source, 2, layout);
  const auto hour = [&](std::size_t line) {
    const int number = static_cast<int>(line) + 1;
    return nsrdb_clock(csv_fields(lines[line], source, number), source, number).hour;
  };
  if (lines.size() > kHeadLines + 1) {
    const double apart = hour(kHeadLines + 1) - hour(kHeadLines);
    if (apart > 0 && apart < 1) layout.interval_h = apart;
  }
  return layout;
}

constexpr std::string_view kPvgisHead = "Latitude (decimal degrees)", kPvgisColumns = "time(UTC),";

// Facts, the years of the months, the rows, and after a blank line the meaning of the columns.
WeatherLayout pvgis_layout(const std::vector<std::string>& lines, std::string_view source) {
  std::map<std::string, double, std::less<>> facts;
  std::size_t at = 0;
  for (; at < lines.size() && !lines[at].starts_with(kPvgisColumns); ++at) {
    const std::size_t colon = lines[at].find(':');
    if (colon == std::string::npos) continue;
    const std::string_view line = lines[at];
    if (const auto value = csv_number(trim(line.substr(colon + 1))))
      facts.emplace(trim(line.substr(0, colon)), *value);
  }
  if (at == lines.size())
    throw std::invalid_argument(
        fmt::format("{}: expected a line of columns {}.., as the typical year of PVGIS has it",
                    source, kPvgisColumns));
  const auto fact = [&](std::string_view name) {
    if (const auto found = facts.find(name); found != facts.end()) return found->second;
    throw std::invalid_argument(fmt::format("{}: expected a line {}: and a number", source, name));
  };
  const int line = static_cast<int>(at) + 1;
  const Columns columns{csv_fields(lines[at], source, line), source, line};
  WeatherLayout layout{.first_row = at + 1,
                       .ends_at_blank_line = true,
                       .fields = comma_fields,
                       .clock = pvgis_clock,
                       .direct = columns.required("Gb(n)"),
                       .diffuse = columns.required("Gd(h)"),
                       .global = columns.find("G(h)")};
  layout.site = site_of(fact(kPvgisHead), fact("Longitude (decimal degrees)"),
                        fact("Elevation (m)"), 0, source);
  // Before PVGIS 5.2 files do not say how long after the stamp the satellite looked.
  if (const auto later = facts.find("Irradiance Time Offset (h)"); later != facts.end()) {
    if (!(std::abs(later->second) <= 1))
      throw std::invalid_argument(fmt::format(
          "{}: Irradiance Time Offset = {:.9g} h: expected -1 to 1", source, later->second));
    layout.middle_after_stamp_h = later->second;
  }
  return layout;
}

}  // namespace

double weather_number(const std::vector<std::string>& fields, std::size_t i, std::string_view name,
                      std::string_view source, int line) {
  const std::optional<double> value =
      i < fields.size() ? csv_number(fields[i]) : std::optional<double>{};
  if (value && std::isfinite(*value)) return *value;
  fail_at(source, line,
          fmt::format("{} = {}: expected a number", name,
                      in_quotes(i < fields.size() ? fields[i] : std::string())));
}

WeatherLayout weather_layout(const std::vector<std::string>& lines, std::string_view source) {
  const std::string_view first = lines.empty() ? std::string_view() : lines[0];
  if (first.starts_with("LOCATION,") || first.starts_with("\"LOCATION\","))
    return epw_layout(lines, source);
  if (words_of(first).size() > 1 && words_of(first)[0] == "place") return wea_layout(lines, source);
  if (first_match(first, tmy2_head())) return tmy2_layout(lines, source);
  if (lines.size() > 1 && lines[1].starts_with("Date (MM/DD/YYYY)"))
    return tmy3_layout(lines, source);
  if (first.starts_with(kNsrdbHead)) return nsrdb_layout(lines, source);
  if (first.starts_with(kPvgisHead)) return pvgis_layout(lines, source);
  throw std::invalid_argument(
      fmt::format("{}: no weather file, expected EPW, WEA, TMY2, TMY3, NSRDB or PVGIS", source));
}

}  // namespace skyfit::refs
