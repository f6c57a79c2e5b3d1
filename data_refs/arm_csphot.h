// SPDX-License-Identifier: Apache-2.0
// Almucantars of the Cimel sun photometers of ARM, NetCDF files of the datastream csphotalm.a1: the
// sky radiances that AERONET made of them. Layout: the header of such a file that ARM shows, at
// archive.arm.gov/headers/tmpcsphotalmM1.a1.header.txt; read are
//   base_time, time_offset(time)  seconds since 1970, and from there, UTC
//   wavelength(time)              um
//   zenith(time)                  of the sun, degrees
//   azimuth(azimuth)              from the sun, degrees
//   alm_rad(time, azimuth)        microWatt/(cm^2 * nm * ster); negative or not finite: missing
//   lat, lon, alt                 degrees north and east, m
// The header says nothing of missing values; AERONET's are -999. NetCDF is read through the module
// that fit/exchange has.
#pragma once

#include <filesystem>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

// By the first bytes of the file: of NetCDF-3 or of HDF5, which NetCDF-4 is.
bool is_netcdf(const std::filesystem::path& file);

// Throws std::invalid_argument in one line that names the file and the variable when it is no such
// datastream, std::runtime_error when it cannot be read.
Reference load_arm_csphot(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace skyfit::refs
