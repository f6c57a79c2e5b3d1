// SPDX-License-Identifier: Apache-2.0
// Irradiances of measurements as a reference, from one of
//
//   direct_normal=83000lx,diffuse_horizontal=14000:700lx    NAME=VALUE[:SIGMA]UNIT, of one sun
//   direct_normal=850W/m2,global_horizontal=640W/m2,precipitable_water=14mm
//   FILE.csv                                                a line for each sun
//   FILE.epw@2026-06-21T12:00[,precipitable_water=14mm]     an hour of a weather file
//
// The names are kIrradianceNames (model/irradiance.h); direct, diffuse and global are short for
// direct_normal, diffuse_horizontal and global_horizontal. The unit is lx or klx of an illuminance
// or W/m2 of an irradiance of all wavelengths, one quantity for all. W/m2 need the column of water
// vapour.
//
// The CSV has columns of these names and the unit, direct_normal_lx or direct_normal_w_m2, and
// optionally the same with _sigma behind. The sun is in sun_zenith_deg, or computed from the column
// time and the site of the file's head or the options. precipitable_water_mm goes with W/m2,
// altitude_m is the site's elevation. Another column is an error. An empty field was not measured.
// A line without a sun above the horizon or without a value is left out and noted.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

// `sun_zenith`, radians, is the sun of values on the command line where `options` state no time and
// site. Each scan of the reference has one sun. A value that is not positive has weight 0. Throws
// std::invalid_argument or std::runtime_error with one line.
Reference irradiance_reference(std::string_view text, std::optional<double> sun_zenith,
                               const ImportOptions& options);

// The CSV alone, whatever its path has in it.
Reference irradiance_table(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace skyfit::refs
