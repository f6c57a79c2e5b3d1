// SPDX-License-Identifier: Apache-2.0
// Irradiances of weather files, hour by hour: EnergyPlus (EPW), Radiance's gendaymtx (WEA), TMY2
// and TMY3. Layouts: EnergyPlus, Auxiliary Programs, "EnergyPlus Weather File (EPW) Data
// Dictionary"; Radiance, manual page of gendaymtx; Marion & Urban 1995, User's Manual for TMY2s,
// tables 3-1 and 3-2; Wilcox & Marion 2008, Users Manual for TMY3 Data Sets. The
// years of their rows are of a typical year and not read: an hour is found by month, day and clock.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "data_refs/civil_time.h"
#include "data_refs/perez_sky.h"
#include "data_refs/solar_position.h"

namespace skyfit::refs {

// The sun is that of the interval's middle, in WEA files of the stated time, as gendaymtx
// has it.
struct WeatherHour {
  Instant middle;
  Site site;
  double direct_normal_w_m2 = 0, diffuse_horizontal_w_m2 = 0;
  std::optional<double> precipitable_water_mm;  // where the file has it: EPW, TMY2, TMY3
};

// Of "FILE@YYYY-MM-DDTHH:MM" in the file's own standard time, the interval that contains it, where
// two meet the later one. Throws
// std::invalid_argument or std::runtime_error with one line that names file, line, field, value and
// what was expected.
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
