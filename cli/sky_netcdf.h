// SPDX-License-Identifier: Apache-2.0
// The NetCDF and the .npz of `skyfit sky`: every column a variable over the lists that were given.
#pragma once

#include <string>
#include <vector>

#include "cli/sky_table.h"
#include "fit/exchange/netcdf_file.h"

namespace skyfit::cli {

struct GridAxis {
  std::string name, long_name, units;
  std::vector<double> values;
};

// `values`: one number per column of every point of the grid, the last axis fastest.
fit::NetcdfFile sky_netcdf(const std::string& title, const std::vector<GridAxis>& axes,
                           const std::vector<SkyColumn>& columns,
                           const std::vector<double>& values);

// The arrays of that file as .npz: each axis, and each column over the axes.
void write_sky_npz(const std::string& file, const fit::NetcdfFile& sky);

}  // namespace skyfit::cli
