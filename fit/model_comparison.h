// SPDX-License-Identifier: Apache-2.0
// How far sky models are from a reference, with one atmosphere and fitted, and what they cost.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fit/fit.h"

namespace skyfit::fit {

// Errors of log(model / reference) over the samples with weight outside FitOptions::exclude_sun,
// every scan with its own scale, which is profiled out.
struct ModelErrors {
  int samples = 0;  // that the model can do and that are compared
  double rms_log_percent = 0;
  double scale = 0;           // geometric mean over the scans of reference / model; for a relative
                              // reference in its own unit
  double worst_percent = 0;   // 100 log, of the largest error
  std::size_t worst = 0;      // its sample
  std::vector<double> model;  // per sample that is compared, with its scan's scale; else NaN
};

struct ModelComparison {
  std::string model;
  Transfer transfer = Transfer::kScalar;
  std::string problem;  // what it cannot do of the reference; empty: all
  std::optional<ModelErrors> unfitted;
  std::optional<ModelErrors> fitted;
  std::string fit_problem;  // why it could not be fitted
  std::optional<Result> fit;
  double precompute_seconds = 0;     // of the model's tables, for the nodes of the reference
  std::size_t table_bytes = 0;       // in double precision
  double seconds_per_direction = 0;  // of all nodes; of a model without tables, everything
};

// What of a reference can be compared: spectra that give a luminance (refs::gives_luminance()) as
// luminances, 683.002 lm/W times the integral of y_bar L by trapezoids, of the directions whose
// samples all have weight. Others as they are, each wavelength by itself under one scale per scan.
refs::Reference comparison_reference(const refs::Reference& reference, const SpectralData& spectra);

// `atmosphere` is what the unfitted model is given; `options`: fit, from there, with as many lobes
// as the model can tell. Suns that the model refuses, and samples at which it is not bright, are
// left out, and `problem` says so; throws std::invalid_argument for a reference that has no sample
// to compare.
ModelComparison compare_model(const refs::Reference& reference, const SpectralData& spectra,
                              const SkyModel& model, const Atmosphere<double>& atmosphere,
                              double exclude_sun, const FitOptions* options);

// One row per model. The text has at most 120 columns, but for remarks.
std::string comparison_text(const refs::Reference& reference,
                            const std::vector<ModelComparison>& rows);
std::string comparison_csv(const refs::Reference& reference,
                           const std::vector<ModelComparison>& rows);
nlohmann::json comparison_json(const refs::Reference& reference,
                               const std::vector<ModelComparison>& rows);

}  // namespace skyfit::fit
