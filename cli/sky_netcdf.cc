// SPDX-License-Identifier: Apache-2.0
#include "cli/sky_netcdf.h"

namespace skyfit::cli {

fit::NetcdfFile sky_netcdf(const std::string& title, const std::vector<GridAxis>& axes,
                           const std::vector<SkyColumn>& columns,
                           const std::vector<double>& values) {
  fit::NetcdfFile file = fit::netcdf_file(title);
  std::vector<std::string> names;
  for (const GridAxis& axis : axes) {
    names.push_back(axis.name);
    file.dimensions.emplace_back(axis.name, axis.values.size());
    file.variables.push_back({axis.name, {axis.name}, axis.values, axis.long_name, axis.units});
  }
  for (std::size_t c = 0; c < columns.size(); ++c) {
    std::vector<double> own;
    for (std::size_t i = c; i < values.size(); i += columns.size()) own.push_back(values[i]);
    file.variables.push_back(
        {columns[c].name, names, std::move(own), columns[c].name, columns[c].units});
  }
  return file;
}

}  // namespace skyfit::cli
