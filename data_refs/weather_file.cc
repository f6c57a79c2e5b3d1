// SPDX-License-Identifier: Apache-2.0
#include "data_refs/weather_file.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <numbers>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "data_refs/closure.h"
#include "data_refs/csv.h"
#include "model/base/input_file.h"
#include "model/base/pattern.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"
#include "model/photometry/broadband.h"

namespace skyfit::refs {
namespace {

struct Clock {
  unsigned month, day;
  double middle;  // of the interval, hours of the day
};

std::vector<std::string> words_of(std::string_view line, std::string_view = {}, int = 0) {
  std::istringstream in{std::string(line)};
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

std::vector<std::string> comma_fields(std::string_view line, std::string_view source, int number) {
  return csv_fields(line, source, number);
}

// What a file says of itself and how its rows are read.
struct Layout {
  Site site = {};
  double utc_offset_h = 0;
  int first_row = 0;  // line
  std::vector<std::string> (*fields)(std::string_view line, std::string_view source,
                                     int number) = comma_fields;
  double interval_h = 1;
  std::size_t direct = 0, diffuse = 0;     // fields of a row
  std::optional<std::size_t> water = {};   // precipitable water
  std::optional<std::size_t> global = {};  // horizontal
  double mm_per_water = 1;
  Clock (*clock)(const std::vector<std::string>& fields, double interval_h, std::string_view source,
                 int line) = nullptr;
};

double number_of(const std::vector<std::string>& fields, std::size_t i, std::string_view name,
                 std::string_view source, int line) {
  const std::optional<double> value =
      i < fields.size() ? csv_number(fields[i]) : std::optional<double>{};
  if (value && std::isfinite(*value)) return *value;
  fail_at(source, line,
          fmt::format("{} = \"{}\": expected a number", name,
                      i < fields.size() ? fields[i] : std::string()));
}

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

// The hour is the one that ends, from 1; the minute the end of the interval in it, 60 or 0 of whole
// hours.
Clock epw_clock(const std::vector<std::string>& fields, double interval_h, std::string_view source,
                int line) {
  const double hour = number_of(fields, 3, "hour", source, line);
  if (!(hour >= 1 && hour <= 24))
    fail_at(source, line, fmt::format("hour = {:.9g}: expected 1 to 24, the hour that ends", hour));
  const double minute = interval_h < 1 ? number_of(fields, 4, "minute", source, line) : 60;
  return {static_cast<unsigned>(number_of(fields, 1, "month", source, line)),
          static_cast<unsigned>(number_of(fields, 2, "day", source, line)),
          hour - 1 + minute / 60 - 0.5 * interval_h};
}

// gendaymtx takes the sun of the stated hour.
Clock wea_clock(const std::vector<std::string>& fields, double, std::string_view source, int line) {
  return {static_cast<unsigned>(number_of(fields, 0, "month", source, line)),
          static_cast<unsigned>(number_of(fields, 1, "day", source, line)),
          number_of(fields, 2, "hour", source, line)};
}

// The hour is the one that ends, from 1.
Clock tmy2_clock(const std::vector<std::string>& fields, double interval_h, std::string_view source,
                 int line) {
  return {static_cast<unsigned>(number_of(fields, 0, "month", source, line)),
          static_cast<unsigned>(number_of(fields, 1, "day", source, line)),
          number_of(fields, 2, "hour", source, line) - 0.5 * interval_h};
}

// MM/DD/YYYY and HH:MM, 24:00 for midnight.
Clock tmy_clock(const std::vector<std::string>& fields, double interval_h, std::string_view source,
                int line) {
  unsigned month = 0, day = 0, hour = 0, minute = 0;
  if (fields.size() < 2 || std::sscanf(fields[0].c_str(), "%2u/%2u/", &month, &day) != 2 ||
      std::sscanf(fields[1].c_str(), "%2u:%2u", &hour, &minute) != 2)
    fail_at(source, line, "expected a date MM/DD/YYYY and a time HH:MM");
  return {month, day, hour + minute / 60.0 - 0.5 * interval_h};
}

Layout epw_layout(const std::vector<std::string>& lines, std::string_view source) {
  const std::vector<std::string> fields = csv_fields(lines[0], source, 1);
  Layout layout{
      .first_row = 9, .direct = 14, .diffuse = 15, .water = 28, .global = 13, .clock = epw_clock};
  layout.utc_offset_h = number_of(fields, 8, "time zone", source, 1);
  layout.site = site_of(number_of(fields, 6, "latitude", source, 1),
                        number_of(fields, 7, "longitude", source, 1),
                        number_of(fields, 9, "elevation", source, 1), layout.utc_offset_h, source);
  if (lines.size() > 7) {  // DATA PERIODS, their number, records per hour
    const double records =
        number_of(csv_fields(lines[7], source, 8), 2, "records per hour", source, 8);
    if (!(records >= 1 && records <= 60))
      fail_at(source, 8, fmt::format("records per hour = {:.9g}: expected 1 to 60", records));
    layout.interval_h = 1 / records;
  }
  return layout;
}

// West is positive, and so is the meridian of its time.
Layout wea_layout(const std::vector<std::string>& lines, std::string_view source) {
  Layout layout{.first_row = 7, .fields = words_of, .direct = 3, .diffuse = 4, .clock = wea_clock};
  const auto header = [&](std::size_t line, const std::string& name) {
    const std::vector<std::string> words =
        line < lines.size() ? words_of(lines[line]) : std::vector<std::string>{};
    if (words.empty() || words[0] != name)
      fail_at(source, static_cast<int>(line) + 1, fmt::format("expected a line {}", name));
    return number_of(words, 1, name, source, static_cast<int>(line) + 1);
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

Layout tmy_layout(const std::vector<std::string>& lines, std::string_view source) {
  const std::vector<std::string> fields = csv_fields(lines[0], source, 1),
                                 names = csv_fields(lines.at(1), source, 2);
  Layout layout{.first_row = 3, .clock = tmy_clock};
  const auto column_if_there = [&](std::string_view name) -> std::optional<std::size_t> {
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (names[i].starts_with(name)) return i;
    }
    return {};
  };
  const auto column = [&](std::string_view name) {
    if (const auto at = column_if_there(name)) return *at;
    fail_at(source, 2, fmt::format("expected a column {}", name));
  };
  layout.direct = column("DNI (");
  layout.diffuse = column("DHI (");
  layout.water = column_if_there("Pwat (cm)");
  layout.global = column_if_there("GHI (");
  layout.mm_per_water = 10;
  layout.utc_offset_h = number_of(fields, 3, "time zone", source, 1);
  layout.site = site_of(number_of(fields, 4, "latitude", source, 1),
                        number_of(fields, 5, "longitude", source, 1),
                        number_of(fields, 6, "elevation", source, 1), layout.utc_offset_h, source);
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
  struct Columns {
    std::size_t first, count;  // the first of a line is 1
  };
  std::vector<std::string> fields;
  for (const auto [first, count] : {Columns{4, 2}, {6, 2}, {8, 2}, {24, 4}, {30, 4}, {124, 3}}) {
    if (line.size() < first) break;
    fields.emplace_back(trim(line.substr(first - 1, count)));
  }
  return fields;
}

Layout tmy2_layout(const std::vector<std::string>& lines, std::string_view source) {
  const std::cmatch head = *first_match(lines[0], tmy2_head());
  const auto degrees = [&](std::size_t side, char negative) {
    const double value = std::stod(head[side + 1]) + std::stod(head[side + 2]) / 60;
    return head[side].str()[0] == negative ? -value : value;
  };
  Layout layout{.first_row = 2,
                .fields = tmy2_fields,
                .direct = 3,
                .diffuse = 4,
                .water = 5,
                .clock = tmy2_clock};
  layout.utc_offset_h = std::stod(head[1]);
  layout.site =
      site_of(degrees(2, 'S'), degrees(5, 'W'), std::stod(head[8]), layout.utc_offset_h, source);
  return layout;
}

// Nothing where the file has none; 999 and -9900 stand for a missing value.
std::optional<double> water_of(const std::vector<std::string>& fields, const Layout& layout) {
  constexpr double kMost_mm = 100;
  if (!layout.water || *layout.water >= fields.size()) return {};
  const std::optional<double> water = csv_number(fields[*layout.water]);
  const double mm = water.value_or(0) * layout.mm_per_water;
  if (!(mm > 0 && mm <= kMost_mm)) return {};
  return mm;
}

// Where the file has the light of sun and sky together, the sun of the hour must make it of the
// two: a longitude or a time zone of the wrong sign does not.
void expect_closure(const WeatherHour& hour, const std::vector<std::string>& fields,
                    const Layout& layout, std::string_view source, int line) {
  constexpr double kLeast = 150, kMost = 2000;  // W/m^2; 9999 stands for a missing value
  if (!layout.global || *layout.global >= fields.size()) return;
  const double global = csv_number(fields[*layout.global]).value_or(0),
               zenith = solar_position(hour.middle, hour.site).zenith,
               direct = hour.direct_normal_w_m2 * std::max(std::cos(zenith), 0.0);
  if (!(hour.direct_normal_w_m2 > kLeast && global > kLeast && global < kMost)) return;
  // The middle of an hour of a low sun says little of the hour; there is no beam at night.
  if (zenith > kHighSun && zenith < 0.5 * std::numbers::pi) return;
  const double ratio = closure(global, direct, hour.diffuse_horizontal_w_m2);
  if (std::abs(ratio - 1) <= kAnotherSun) return;
  fail_at(
      source, line,
      fmt::format("global horizontal = {:.9g} W/m^2 is {:.3g} times direct and diffuse under a sun "
                  "{:.1f} deg from the zenith, expected within {:g} of 1; longitude or time zone "
                  "may be wrong",
                  global, ratio, zenith * kDegreesPerRadian, kAnotherSun));
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.ends_with('\r')) line.pop_back();
    lines.push_back(line);
  }
  return lines;
}

Layout layout_of(const std::vector<std::string>& lines, std::string_view source) {
  if (!lines.empty() && lines[0].starts_with("LOCATION,")) return epw_layout(lines, source);
  if (!lines.empty() && words_of(lines[0]).size() > 1 && words_of(lines[0])[0] == "place")
    return wea_layout(lines, source);
  if (!lines.empty() && first_match(lines[0], tmy2_head())) return tmy2_layout(lines, source);
  if (lines.size() > 1 && lines[1].starts_with("Date (MM/DD/YYYY)"))
    return tmy_layout(lines, source);
  throw std::invalid_argument(
      fmt::format("{}: no weather file, expected EPW, WEA, TMY2 or TMY3", source));
}

}  // namespace

WeatherHour weather_hour(std::string_view file_and_time) {
  const std::size_t at = file_and_time.rfind('@');
  const std::string file(file_and_time.substr(0, at)), time(file_and_time.substr(at + 1));
  const std::optional<Instant> wanted = instant(time, 0);
  if (!wanted || stated_utc_offset_h(time)) {
    throw std::invalid_argument(
        fmt::format("{}: time = \"{}\": expected YYYY-MM-DDTHH:MM of a day that exists, on the "
                    "file's own clock",
                    file, printable(time)));
  }
  const auto day = std::chrono::floor<std::chrono::days>(*wanted);
  const std::chrono::year_month_day date(day);
  const double clock = std::chrono::duration<double, std::ratio<3600>>(*wanted - day).count();
  const std::vector<std::string> lines = lines_of(read_text_file(file, "a weather file"));
  const Layout layout = layout_of(lines, file);
  WeatherHour found;
  double nearest = 0.5 * layout.interval_h + 1e-9;  // hours from the middle
  bool is_there = false;
  for (std::size_t i = static_cast<std::size_t>(layout.first_row) - 1; i < lines.size(); ++i) {
    if (trim(lines[i]).empty()) continue;
    const int line = static_cast<int>(i) + 1;
    const std::vector<std::string> fields = layout.fields(lines[i], file, line);
    const Clock row = layout.clock(fields, layout.interval_h, file, line);
    // Where two intervals meet, the one that begins.
    const double apart = std::abs(row.middle - clock);
    if (row.month != static_cast<unsigned>(date.month()) ||
        row.day != static_cast<unsigned>(date.day()) || apart > nearest)
      continue;
    is_there = true;
    nearest = apart;
    found.middle =
        day + std::chrono::milliseconds(std::llround((row.middle - layout.utc_offset_h) * 3.6e6));
    found.site = layout.site;
    found.direct_normal_w_m2 = number_of(fields, layout.direct, "direct normal", file, line);
    found.diffuse_horizontal_w_m2 =
        number_of(fields, layout.diffuse, "diffuse horizontal", file, line);
    found.precipitable_water_mm = water_of(fields, layout);
    constexpr double kMost = 2000;  // W/m^2; 9999 stands for a missing value
    for (const auto& [name, value] : {std::pair{"direct normal", found.direct_normal_w_m2},
                                      {"diffuse horizontal", found.diffuse_horizontal_w_m2}}) {
      if (!(value >= 0 && value < kMost))
        fail_at(file, line, fmt::format("{} = {:.9g}: expected 0 to 2000 W/m^2", name, value));
    }
    expect_closure(found, fields, layout, file, line);
  }
  if (is_there) return found;
  throw std::invalid_argument(
      fmt::format("{}: time = {}: expected an hour that the file has", file, printable(time)));
}

PerezHour perez_hour(const WeatherHour& hour, std::string_view name) {
  constexpr double kSolarConstant = 1367, kKappa = 1.041;
  PerezHour result;
  result.sun = solar_position(hour.middle, hour.site);
  const double zenith = result.sun.zenith, zenith_deg = zenith * kDegreesPerRadian;
  if (!(zenith_deg < 89)) {
    throw std::invalid_argument(
        fmt::format("{}: the sun of {} is {:.2f} deg from the zenith: expected less than 89; "
                    "longitude or time zone may be wrong",
                    name, iso_text(hour.middle), zenith_deg));
  }
  constexpr double kLeast = 1;  // W/m^2
  if (!(hour.diffuse_horizontal_w_m2 >= kLeast)) {
    throw std::invalid_argument(
        fmt::format("{}: diffuse horizontal = {:.9g} W/m^2: expected at least 1", name,
                    hour.diffuse_horizontal_w_m2));
  }
  const double cube = kKappa * zenith * zenith * zenith;
  result.sky.epsilon =
      ((hour.diffuse_horizontal_w_m2 + hour.direct_normal_w_m2) / hour.diffuse_horizontal_w_m2 +
       cube) /
      (1 + cube);
  result.sky.delta = relative_air_mass(zenith) * hour.diffuse_horizontal_w_m2 *
                     result.sun.distance_au * result.sun.distance_au / kSolarConstant;
  if (!(result.sky.delta > 0 && result.sky.delta <= 1)) {
    throw std::invalid_argument(
        fmt::format("{}: brightness {:.4g} of {:.9g} W/m^2 of diffuse light: expected at most 1",
                    name, result.sky.delta, hour.diffuse_horizontal_w_m2));
  }
  return result;
}

}  // namespace skyfit::refs
