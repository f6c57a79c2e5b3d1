// SPDX-License-Identifier: Apache-2.0
// What fit/exchange/netcdf_file.cc and data_refs/arm_csphot.cc call in skyfit_netcdf_module
// (model/base/module_file.h), which loads the NetCDF library.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace skyfit::fit {

// A variable over dimensions of the file, the last one fastest. A number that is not known is NaN,
// its _FillValue; of a file that is read also what missing_value or the default of NetCDF says.
// What is packed by scale_factor and add_offset is read unpacked, as doubles. `units` is "1" of a
// number without, and empty of texts and where each value has its own.
struct NetcdfVariable {
  std::string name;  // letters, digits and _
  std::vector<std::string> dimensions;
  std::variant<std::vector<double>, std::vector<int>, std::vector<std::string>> values;
  std::string long_name, units;
  std::string coordinates = {};  // names of variables that say where its values are, by CF
};

struct NetcdfFile {
  std::vector<std::pair<std::string, std::size_t>> dimensions;
  std::vector<NetcdfVariable> variables;
  std::vector<std::pair<std::string, std::string>> attributes;  // of the whole
};

struct NetcdfModule {
  static constexpr int kRevision = 3;
  int revision;
  // What the file holds that the caller writes. Throws std::runtime_error `file: cannot be written:
  // ...`.
  std::string (*bytes)(const std::filesystem::path& file, const NetcdfFile& content);
  // Throws std::runtime_error `file: cannot be read: ...`.
  NetcdfFile (*read)(const std::filesystem::path& file);
};

}  // namespace skyfit::fit

// The module's only symbol.
extern "C" const void* skyfit_netcdf_module();
