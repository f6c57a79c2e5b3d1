// SPDX-License-Identifier: Apache-2.0
// How weather files lay out their rows: EnergyPlus (EPW), Radiance's gendaymtx (WEA), TMY2, TMY3,
// NREL's NSRDB and the typical year of PVGIS. Layouts: EnergyPlus, Auxiliary Programs, "EnergyPlus
// Weather File (EPW) Data Dictionary"; Radiance, manual page of gendaymtx; Marion & Urban 1995,
// User's Manual for TMY2s, tables 3-1 and 3-2; Wilcox & Marion 2008, Users Manual for TMY3 Data
// Sets; the downloads of NSRDB (PSM 3 and 4) and of PVGIS 5.1 to 5.3 themselves.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data_refs/solar_position.h"

namespace skyfit::refs {

// What the time stamp of a row says, on the clock of the file.
struct WeatherClock {
  unsigned month, day;
  double hour;  // of the day, with its fraction
};

// Irradiances are W/m^2.
struct WeatherLayout {
  Site site = {};
  double utc_offset_h = 0;
  std::size_t first_row = 0;        // lines before it
  bool ends_at_blank_line = false;  // else blank lines are passed over
  std::vector<std::string> (*fields)(std::string_view line, std::string_view source,
                                     int number) = nullptr;
  WeatherClock (*clock)(const std::vector<std::string>& fields, std::string_view source,
                        int line) = nullptr;
  double interval_h = 1;
  double middle_after_stamp_h = 0;         // the instant that the irradiances stand for
  std::size_t direct = 0, diffuse = 0;     // fields of a row
  std::optional<std::size_t> water = {};   // precipitable water
  std::optional<std::size_t> global = {};  // horizontal
  double mm_per_water = 1;
};

// Of a whole file. Throws std::invalid_argument with one line that names file, line, field, value
// and what was expected.
WeatherLayout weather_layout(const std::vector<std::string>& lines, std::string_view source);

// Field `i` of a row. Throws std::invalid_argument `source:line: ...` where it is no number.
double weather_number(const std::vector<std::string>& fields, std::size_t i, std::string_view name,
                      std::string_view source, int line);

}  // namespace skyfit::refs
