// SPDX-License-Identifier: Apache-2.0
// Fits an atmosphere to a reference: maximum a posteriori with Ceres, exact derivatives, the model
// prepared once per step.
//
// Residuals, one per sample:
//   sqrt(weight) * (log(model) - log(reference) + log(scale of the scan)) / sigma_log.
// Every scan (sun position) has one free luminance scale, profiled out exactly: the weighted mean
// of the scan is subtracted from its residuals and from the rows of their Jacobian (variable
// projection; the scale enters linearly). One residual (parameter - mean) / sigma per prior.
//
// sigma_log is sigma / value where the reference states sigma. Where it does not, it is estimated
// from the residuals (noise.h) and the fit repeated with it, so that priors weigh what they say.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "data_refs/samples.h"
#include "model/atmosphere/parameters.h"
#include "model/atmosphere/preset.h"
#include "model/photometry/photometry.h"
#include "model/sky_model.h"

namespace skyfit::fit {

struct FitOptions {
  int lobes = 2;                             // 1 or 2; a tabulated phase function stays
  int starts = 4;                            // >= 1; multi-start of the phase parameters
  int max_iterations = 100;                  // per start, >= 1
  double exclude_sun = 0.05235987755982988;  // radians (3 deg) around the sun that are left out
  int threads = 2;              // >= 1: starts solved at once; results do not depend on it
  std::optional<Preset> start;  // otherwise the table's defaults
  std::optional<double> site_pressure_hpa;     // > 0; otherwise the start's
  std::optional<std::vector<Parameter>> free;  // --free: exactly these
  std::map<Parameter, double> fix;             // --fix
  std::map<Parameter, Prior> priors;           // --prior: in the place of the table's, or besides
  bool use_priors = true;                      // --no-priors: false drops those of the table
  std::function<void(double fraction, const std::string& status)> progress;  // may be empty
};
// Throws std::invalid_argument, one line: `fit.starts = 0: must be >= 1`.
void validate(const FitOptions& options);

struct FittedParameter {
  explicit FittedParameter(const Parameter& parameter) : id(parameter) {}

  Parameter id;
  bool free = false;
  double start = 0;  // NaN when the start has another phase function and thus no such parameter
  double fitted = 0;
  // One standard deviation, priors included, in the parameter's unit. 0 when fixed; NaN at a bound
  // and when neither data nor priors hold the parameter.
  double sigma = 0;
  bool at_bound = false;
  bool identifiable = true;  // false: the answer is the prior's (or nothing holds it)
  std::optional<Prior> prior;
};

struct RmsOfSun {
  double sun_zenith;       // radians
  double rms_log_percent;  // with its own luminance scale profiled out
  double scale;            // reference / model
};

// Root mean square of log(model/reference), percent, one scale per scan profiled out, weighted with
// the samples' weights. NaN when no sample qualifies.
struct RmsSummary {
  double all = 0;           // outside exclude_sun
  double cone3 = 0;         // outside 3 deg around the sun
  double cone10 = 0;        // outside 10 deg around the sun
  double sun_below_70 = 0;  // outside exclude_sun, sun zenith <= 70 deg
};

struct StartSummary {
  std::string name;  // the values of the varied parameters, readable
  double cost = 0;   // half the sum of squares that Ceres minimised
  int iterations = 0;
  bool best = false;
};

struct FitResult {
  Preset preset;                            // with its `fit` member filled
  std::vector<FittedParameter> parameters;  // the atmosphere's parameters, table order, free or not
  // Rows and columns of covariance and correlation: the free parameters that are not at a bound.
  std::vector<Parameter> covariance_parameters;
  Eigen::MatrixXd covariance;        // in the parameters' units; empty when singular
  Eigen::MatrixXd correlation;       // empty when singular
  double condition_number = 0;       // of the normal matrix with unit diagonal, data and priors
  bool sigma_from_residuals = true;  // the reference had no sigma
  double sigma_log_percent = 0;      // of one sample, as the residuals say; see noise.h
  double effective_samples = 0;      // how many independent ones the samples count as
  double chi_square_per_dof = 0;     // of the data, meaningful when the reference states sigma
  int samples = 0, scans = 0;        // that were fitted
  bool converged = false;
  std::string termination;  // Ceres' word for it
  int iterations = 0;       // all starts together
  int model_evaluations = 0, derivative_evaluations = 0;
  double rms_log_percent = 0;  // = fitted_rms.all
  RmsSummary start_rms, fitted_rms;
  std::vector<RmsOfSun> per_sun, start_per_sun;
  std::vector<StartSummary> starts;
  double wall_seconds = 0;
  // Luminance (cd/m^2, without the free scale) per sample of the reference, left out or not.
  std::vector<double> start_model, fitted_model;
  // Per sample: its scan's profiled scale = reference / model; NaN in a scan without a fitted
  // sample.
  std::vector<double> scale, start_scale;
};

// Throws std::invalid_argument for options, a start outside the bounds, or a reference that cannot
// be fitted; std::runtime_error when the solver fails. One line, naming option, value, constraint.
FitResult fit_atmosphere(const refs::Reference& reference, const SpectralData& spectra,
                         const SkyModel& model, const FitOptions& options);

std::string brief_report(const FitResult& result);  // one line
std::string full_report(const FitResult& result);   // tables, at most 100 columns
nlohmann::json report_json(const FitResult& result);

}  // namespace skyfit::fit
