// SPDX-License-Identifier: Apache-2.0
#include "data_refs/weather_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <vector>

#include "data_refs/closure.h"
#include "data_refs/csv.h"
#include "data_refs/weather_layout.h"
#include "model/base/input_file.h"
#include "model/base/text.h"
#include "model/numerics/angles.h"
#include "model/photometry/broadband.h"

namespace skyfit::refs {
namespace {

// Nothing where the file has none; 999 and -9900 stand for a missing value.
std::optional<double> water_of(const std::vector<std::string>& fields,
                               const WeatherLayout& layout) {
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
                    const WeatherLayout& layout, std::string_view source, int line) {
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

}  // namespace

WeatherHour weather_hour(std::string_view file_and_time) {
  const std::size_t at = file_and_time.rfind('@');
  const std::string file(file_and_time.substr(0, at)), time(file_and_time.substr(at + 1));
  const std::optional<Instant> wanted = instant(time, 0);
  if (!wanted || stated_utc_offset_h(time)) {
    throw std::invalid_argument(
        fmt::format("{}: time = {}: expected YYYY-MM-DDTHH:MM of a day that exists, on the "
                    "file's own clock",
                    file, in_quotes(time)));
  }
  const auto day = std::chrono::floor<std::chrono::days>(*wanted);
  const std::chrono::year_month_day date(day);
  const double clock = std::chrono::duration<double, std::ratio<3600>>(*wanted - day).count();
  const std::vector<std::string> lines = lines_of(read_text_file(file, "a weather file"));
  const WeatherLayout layout = weather_layout(lines, file);
  WeatherHour found;
  double nearest = 0.5 * layout.interval_h + 1e-9;  // hours from the middle
  bool is_there = false;
  for (std::size_t i = layout.first_row; i < lines.size(); ++i) {
    if (trim(lines[i]).empty()) {
      if (layout.ends_at_blank_line) break;
      continue;
    }
    const int line = static_cast<int>(i) + 1;
    const std::vector<std::string> fields = layout.fields(lines[i], file, line);
    const WeatherClock row = layout.clock(fields, file, line);
    const double middle = row.hour + layout.middle_after_stamp_h;
    // Where two intervals meet, the one that begins.
    const double apart = std::abs(middle - clock);
    if (row.month != static_cast<unsigned>(date.month()) ||
        row.day != static_cast<unsigned>(date.day()) || apart > nearest)
      continue;
    is_there = true;
    nearest = apart;
    found.middle =
        day + std::chrono::milliseconds(std::llround((middle - layout.utc_offset_h) * 3.6e6));
    found.site = layout.site;
    found.direct_normal_w_m2 = weather_number(fields, layout.direct, "direct normal", file, line);
    found.diffuse_horizontal_w_m2 =
        weather_number(fields, layout.diffuse, "diffuse horizontal", file, line);
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
