// SPDX-License-Identifier: Apache-2.0
// The header of a file in NetCDF's classic formats (CDF-1, 2 and 5; Unidata, NetCDF file format
// specifications), checked before the library reads it: on a damaged one it crashes, or takes all
// memory, and what a cut file lacks it takes for zeros.
#pragma once

#include <filesystem>

namespace skyfit::refs {

// Throws std::invalid_argument `file: NetCDF header: ..: expected ..`. Other formats pass.
void require_sound_netcdf(const std::filesystem::path& file);

}  // namespace skyfit::refs
