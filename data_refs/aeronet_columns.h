// SPDX-License-Identifier: Apache-2.0
// What the names of columns in AERONET's files say (aeronet_table.h).
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "data_refs/photometer_scans.h"

namespace skyfit::refs {

// Whether a line names the columns of sky radiances.
bool names_columns(std::string_view line);

// "solarzenithangle" of "Solar_Zenith_Angle(Degrees)".
std::string plain_name(std::string_view column);

// Nothing where the text is no number, or none that is finite.
std::optional<double> finite_number(std::string_view text);

// -6 of "Radiance_for_Azimuth_Angle_in_Degrees(uW/cm^2/sr/nm)_-6.000".
std::optional<double> number_at_end(std::string_view name);

// The titles of groups of columns, each spread over its group, the last over the rest of the
// columns; empty ones when `fields` are no such line.
std::vector<std::string> group_titles(const std::vector<std::string>& fields, std::size_t columns);

// The angle that a column's name holds, if it is one of radiances. `titled`: titles speak of
// radiances; those of other blocks, as of the parts P1, P2 and P3 of polarised light, are none.
std::optional<double> angle_of(const std::string& column, const std::string& title, bool titled);

bool names_scattering(std::string_view name);
// Whether a column holds scattering angles; radiances may be named by theirs.
bool is_of_scattering(const std::string& column, const std::string& title);

// "uW/cm^2/sr/nm" of "Radiance_for_Azimuth_Angle_in_Degrees(uW/cm^2/sr/nm)"; empty where there is
// none.
std::string unit_in(std::string_view name);

// "Almucantar", "ALM", "Principal_Plane", "PPL", also "Polarized ..", of a type of scans.
std::optional<ScanPath> path_named(std::string_view type);
// The one that a head in lower case names first.
std::optional<ScanPath> path_in_head(std::string_view head);

}  // namespace skyfit::refs
