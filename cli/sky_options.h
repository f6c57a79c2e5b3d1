// SPDX-License-Identifier: Apache-2.0
// The options of `skyfit sky` and its help.
#pragma once

#include <string>

#include "cli/arguments.h"
#include "cli/inputs.h"

namespace skyfit::cli {

inline constexpr int kMaxOrders = 20;  // of --orders

// As they were typed; lists are not yet read.
struct SkyOptions {
  std::string preset, site_pressure, model = "reference";
  std::string altitude = "0", sun_zenith, view_zenith, azimuth = "0", wavelength, netcdf, npz;
  bool luminance = false, color = false, irradiance = false, sigma = false;
  bool stokes = false, iau = false, scalar = false, refraction = false, apparent_sun = false;
  int orders = 0;
  int threads = default_threads();

  bool prints_csv() const { return netcdf.empty() && npz.empty(); }
};

void add_sky_options(CLI::App& command, SkyOptions& options);

}  // namespace skyfit::cli
