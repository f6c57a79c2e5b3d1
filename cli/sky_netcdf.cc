// SPDX-License-Identifier: Apache-2.0
#include "cli/sky_netcdf.h"

#include <algorithm>
#include <map>
#include <utility>
#include <variant>

#include "model/base/npz_file.h"

namespace skyfit::cli {
namespace {

std::string with_blanks(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

}  // namespace

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
        {columns[c].name, names, std::move(own), with_blanks(columns[c].name), columns[c].units});
  }
  return file;
}

void write_sky_npz(const std::string& file, const fit::NetcdfFile& sky) {
  const std::map<std::string, std::size_t> size(sky.dimensions.begin(), sky.dimensions.end());
  std::vector<NamedArray> arrays;
  for (const fit::NetcdfVariable& variable : sky.variables) {
    NamedArray array{variable.name, {}, std::get<std::vector<double>>(variable.values)};
    for (const std::string& dimension : variable.dimensions)
      array.shape.push_back(size.at(dimension));
    arrays.push_back(std::move(array));
  }
  write_npz(file, arrays);
}

}  // namespace skyfit::cli
