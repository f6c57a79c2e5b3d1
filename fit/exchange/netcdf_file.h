// SPDX-License-Identifier: Apache-2.0
// NetCDF-4 files by the CF conventions, version 1.8 (cfconventions.org): what a fit, a table of the
// sky, a comparison and a campaign leave for other people's programs.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "fit/exchange/netcdf/netcdf_module.h"

namespace skyfit::fit {

// With the attributes that every file has: Conventions, title, source (this version of skyfit).
NetcdfFile netcdf_file(std::string_view title);

// Names `coordinates` (variables of the dimension alone) in those variables of the dimension that
// are none of them.
void set_coordinates(NetcdfFile& file, std::string_view dimension,
                     const std::vector<std::string>& coordinates);

// Appears whole or not at all. Throws std::runtime_error with one line that names the file.
void write_netcdf(const std::filesystem::path& file, const NetcdfFile& content);

// A file that skyfit wrote: variables of doubles, integers and texts. Throws as above.
NetcdfFile read_netcdf(const std::filesystem::path& file);

// Throws std::runtime_error `source: no variable NAME of this kind`.
template <class Values>
const Values& netcdf_values(const NetcdfFile& file, std::string_view variable,
                            std::string_view source);

}  // namespace skyfit::fit
