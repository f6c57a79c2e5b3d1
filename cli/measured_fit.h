// SPDX-License-Identifier: Apache-2.0
// The part of `skyfit fit` that fits measured skies: absolute or spectral, one scan or several.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "data_refs/samples.h"
#include "fit/measured.h"
#include "model/base/whole_file.h"

namespace skyfit::cli {

struct MeasuredArguments {
  std::string per_scan, scale, pointing, noise, loss, ground, hold_out;
  std::vector<std::string> profiles;
  int bootstrap = 0, seed = 1;
  bool keep_absorption_bands = false;
};
void add_measured_options(CLI::App& command, MeasuredArguments& arguments);

// Spectra, several scans of absolute luminance, and everything for which one of the options above
// was given. Throws UsageError where such an option meets a relative luminance.
bool is_measured_fit(const CLI::App& command, const refs::Reference& reference);

// Names of the files that such a fit leaves.
std::vector<std::string> measured_files();

// Takes the priors of the instrument out of `priors`. Throws UsageError.
std::map<fit::Instrument, Prior> take_instrument_priors(std::vector<std::string>& priors);

// Fits, publishes the result and prints the report. Throws UsageError or what the fit throws.
void run_measured_fit(const MeasuredArguments& arguments, refs::Reference reference,
                      fit::MeasuredOptions options, const SkyModel& model, bool json,
                      const WholeDirectory& out);

}  // namespace skyfit::cli
