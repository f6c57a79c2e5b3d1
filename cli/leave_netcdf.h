// SPDX-License-Identifier: Apache-2.0
// NetCDF files that a command leaves.
#pragma once

#include <string>

#include "fit/exchange/netcdf_file.h"

namespace skyfit::cli {

// With the command that made it as `history`, as CF has it. Throws as fit::write_netcdf().
void leave_netcdf(const std::string& file, fit::NetcdfFile content);

}  // namespace skyfit::cli
