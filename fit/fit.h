// SPDX-License-Identifier: Apache-2.0
// Fits an atmosphere to a reference: maximum a posteriori with Ceres, exact derivatives, the model prepared once per step.
// Residuals: sqrt(weight) * (log(scale_s * model) - log(reference)) / sigma_log, one free luminance scale per scan,
// profiled out for relative references; plus one residual (p - mean) / sigma per prior.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "data_refs/samples.h"
#include "model/parameters.h"
#include "model/photometry.h"
#include "model/preset.h"
#include "model/sky_model.h"

namespace skyfit::fit {

struct FitOptions {
  int lobes = 2;                                // 1 or 2
  int starts = 4;                               // >= 1; multi-start of the phase parameters
  int max_iterations = 100;                     // per start, >= 1
  double exclude_sun = 0.05235987755982988;     // radians (3 deg) around the sun that are left out
  int threads = 2;
  std::optional<Preset> start;                  // otherwise the table's defaults
  std::optional<std::vector<Parameter>> free;   // --free: exactly these
  std::map<Parameter, double> fix;              // --fix
  std::map<Parameter, Prior> priors;            // --prior, over the table's
  bool use_priors = true;                       // --no-priors
  std::function<void(double fraction, const std::string& status)> progress;
};
void validate(const FitOptions& options);  // throws std::invalid_argument `fit.starts = 0: must be >= 1`

struct FittedParameter {
  Parameter id;
  bool free = false;
  double start = 0, fitted = 0;
  double sigma = 0;               // one standard deviation, prior included; NaN when the covariance is singular
  bool at_bound = false;
  bool identifiable = true;       // false: the answer is the prior's (or nothing holds it)
  std::optional<Prior> prior;
};

struct RmsOfSun {
  double sun_zenith;       // radians
  double rms_log_percent;  // with its own luminance scale profiled out
};

struct FitResult {
  Preset preset;                            // with its `fit` member filled
  std::vector<FittedParameter> parameters;  // the atmosphere's parameters in table order, free or not
  Eigen::MatrixXd covariance;               // of the free parameters, in that order; empty when singular
  double condition_number = 0;              // of the scaled normal matrix (unit diagonal), data and priors
  bool sigma_from_residuals = true;         // the reference had no sigma
  bool converged = false;
  std::string termination;                  // Ceres' word for it
  int iterations = 0;
  double rms_log_percent = 0;       // all samples with weight, exclude_sun cone
  double rms_log_percent_cone3 = 0, rms_log_percent_cone10 = 0;
  std::vector<RmsOfSun> per_sun;
  double wall_seconds = 0;
  std::vector<double> start_model, fitted_model;  // luminance (cd/m^2, without the free scale) per sample of the reference
  std::vector<double> scale;                      // per sample: exp of its scan's profiled log scale, fitted
};

FitResult fit_atmosphere(const refs::Reference& reference, const SpectralData& spectra, const SkyModel& model,
                         const FitOptions& options);

std::string brief_report(const FitResult& result);  // one line
std::string full_report(const FitResult& result);   // table: parameter, unit, start, fitted, one sigma, at bound?
nlohmann::json report_json(const FitResult& result);

}  // namespace skyfit::fit
