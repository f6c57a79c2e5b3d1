// SPDX-License-Identifier: Apache-2.0
// What the options of `skyfit compare` ask for, and the comparison of one model.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/inputs.h"
#include "fit/model_comparison.h"
#include "model/sky_model.h"

namespace skyfit::cli {

// The reference that the model `reference` computes for the preset.
inline constexpr const char* kOurs = "model:reference";

struct CompareOptions {
  std::string reference, sampling = "principal", sun_zenith = "0:80:10", models, preset, out,
                         netcdf;
  std::string exclude_sun = "3";
  ImportArguments import;
  int starts = 4, threads = default_threads();
  bool fitted = false, scalar = false, force = false, json = false;
  std::optional<Preset> atmosphere;  // in the place of --preset, of a caller that has it in memory
};

// All but those of the directory of the result.
void add_compare_options(CLI::App& command, CompareOptions& options);

struct CompareRequest {
  Preset preset;
  refs::Reference reference;        // what of it can be compared
  std::vector<std::string> models;  // names of known ones
};

// The second takes a reference that was read before in the place of that of the options. Both throw
// UsageError, and what load_reference() and comparison_reference() throw.
CompareRequest compare_request(const CompareOptions& options);
CompareRequest compare_request(const CompareOptions& options, const refs::Reference& reference);

std::unique_ptr<SkyModel> model_of(const CompareOptions& options, const CompareRequest& request,
                                   const std::string& name);

// One row of the comparison. Throws what compare_model() throws.
fit::ModelComparison compare_with(
    const CompareOptions& options, const CompareRequest& request, const SkyModel& model,
    const std::function<void(double fraction, const std::string& status)>& progress);

}  // namespace skyfit::cli
