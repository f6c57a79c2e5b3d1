// SPDX-License-Identifier: Apache-2.0
// The options of `skyfit fit`: which sky, which unknowns, which likelihood, which checks.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cli/inputs.h"
#include "fit/problem/options.h"
#include "fit/uncertainty/checks.h"
#include "model/sky_model.h"

namespace skyfit::cli {

struct FitArguments {
  std::string reference, irradiance, sampling = "principal", sun_zenith = "0:80:10",
                                     model = "reference";
  bool scalar = false, refraction = false;
  std::string free, preset, site_pressure, out, netcdf, exclude_sun = "3";
  std::string per_scan, link, scale, pointing, noise, loss, ground, hold_out;
  std::string aeronet_aod, aeronet_inversion;
  std::vector<std::string> fix, bounds, prior, profiles;
  ImportArguments import;
  int lobes = 0, starts = 4, max_iterations = fit::FitOptions{}.max_iterations,
      threads = default_threads(), bootstrap = 0, seed = 1;
  bool no_priors = false, keep_absorption_bands = false, force = false, json = false;
  std::optional<Preset> start;  // of a caller that has it in memory, in the place of --preset
};

// Which sky, unknowns, likelihood and checks; and by which model, with how many threads.
void add_fit_options(CLI::App& command, FitArguments& arguments);
void add_fit_model_options(CLI::App& command, FitArguments& arguments);

// Throw UsageError, and std::invalid_argument where options contradict each other.
fit::FitOptions fit_options(const FitArguments& arguments, const SkyModel& model,
                            const CLI::App& command);
// The aerosol that files of AERONET state for the scans of the reference; nothing where no such
// file was given.
std::optional<refs::AerosolKnowledge> known_aerosol(const FitArguments& arguments,
                                                    const refs::Reference& reference);
fit::CheckOptions check_options(const FitArguments& arguments);

// `skyfit fit --reference cie:all`: all standard skies, each by itself, with one table and one
// figure of all (cli/fit_standard_skies.cc).
inline constexpr std::string_view kAllStandardSkies = "cie:all";
void run_standard_skies(const FitArguments& arguments, const CLI::App& command);

}  // namespace skyfit::cli
