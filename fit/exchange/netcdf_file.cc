// SPDX-License-Identifier: Apache-2.0
#include "fit/exchange/netcdf_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "data_refs/netcdf_header.h"
#include "model/base/module_file.h"
#include "model/base/whole_file.h"
#include "model/version.h"

namespace skyfit::fit {
namespace {

const NetcdfModule& module() { return module_named<NetcdfModule>("skyfit_netcdf_module"); }

}  // namespace

NetcdfFile netcdf_file(std::string_view title) {
  return {{},
          {},
          {{"Conventions", "CF-1.8"},
           {"title", std::string(title)},
           {"source", fmt::format("skyfit {}", kVersion)}}};
}

void set_coordinates(NetcdfFile& file, std::string_view dimension,
                     const std::vector<std::string>& coordinates) {
  const auto is_coordinate = [&](const NetcdfVariable& variable) {
    return std::ranges::count(coordinates, variable.name) > 0;
  };
  std::string names;
  for (const NetcdfVariable& variable : file.variables) {
    if (is_coordinate(variable)) names += (names.empty() ? "" : " ") + variable.name;
  }
  for (NetcdfVariable& variable : file.variables) {
    if (std::ranges::count(variable.dimensions, dimension) > 0 && !is_coordinate(variable) &&
        variable.name != dimension)
      variable.coordinates = names;
  }
}

void write_netcdf(const std::filesystem::path& file, const NetcdfFile& content) {
  write_whole_file(file, module().bytes(file, content));
}

NetcdfFile read_netcdf(const std::filesystem::path& file) {
  refs::require_sound_netcdf(file);
  return module().read(file);
}

template <class Values>
const Values& netcdf_values(const NetcdfFile& file, std::string_view variable,
                            std::string_view source) {
  const auto at = std::ranges::find(file.variables, variable, &NetcdfVariable::name);
  if (at == file.variables.end() || !std::holds_alternative<Values>(at->values))
    throw std::runtime_error(fmt::format("{}: no variable {} of this kind", source, variable));
  return std::get<Values>(at->values);
}

template const std::vector<double>& netcdf_values(const NetcdfFile&, std::string_view,
                                                  std::string_view);
template const std::vector<int>& netcdf_values(const NetcdfFile&, std::string_view,
                                               std::string_view);
template const std::vector<std::string>& netcdf_values(const NetcdfFile&, std::string_view,
                                                       std::string_view);

}  // namespace skyfit::fit
