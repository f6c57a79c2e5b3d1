// SPDX-License-Identifier: Apache-2.0
// Irradiances of weather files (data_refs/weather_layout.h), hour by hour. The years of their rows
// are of a typical year and not read: an hour is found by month, day and clock.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "data_refs/civil_time.h"
#include "data_refs/perez_sky.h"
#include "data_refs/solar_position.h"

namespace skyfit::refs {

// The sun is that of the interval's middle; of WEA files that of the stated time, as gendaymtx has
// it; of NSRDB and PVGIS that of the instant that the satellite saw.
struct WeatherHour {
  Instant middle;
  Site site;
  double direct_normal_w_m2 = 0, diffuse_horizontal_w_m2 = 0;
  std::optional<double> precipitable_water_mm;  // where the file has it
};

// Of "FILE@YYYY-MM-DDTHH:MM" on the file's own clock (standard time, of PVGIS UTC), the interval
// that contains it, where two meet the later one. Throws std::invalid_argument or
// std::runtime_error with one line that names file, line, field, value and what was expected.
WeatherHour weather_hour(std::string_view file_and_time);

// Clearness and brightness of the hour and the sun of its middle (Perez et al. 1990, eqs. 1 and 2;
// air mass of Kasten & Young 1989, a solar constant of 1367 W/m^2). Throws std::invalid_argument
// that begins with `name` where the sun is down or there is no diffuse light.
struct PerezHour {
  PerezSky sky;
  SolarPosition sun;
};
PerezHour perez_hour(const WeatherHour& hour, std::string_view name);

}  // namespace skyfit::refs
