// SPDX-License-Identifier: Apache-2.0
// What a fit found.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "fit/problem/likelihood.h"
#include "fit/problem/unknowns.h"
#include "fit/result/errors.h"
#include "model/atmosphere/preset.h"

namespace skyfit::fit {

// Numbers in the unit of the report.
struct UnknownRow {
  Unknown unknown;
  double start = 0;  // NaN when the start has another phase function and thus no such parameter
  double fitted = 0;
  double sigma = 0;  // priors included; NaN at a bound and when nothing holds the unknown
  bool at_bound = false;
  bool identifiable = true;  // false: the answer is the prior's (or nothing holds it)
};

// A parameter of the atmosphere that was not free.
struct FixedRow {
  Parameter parameter;
  double start = 0;  // NaN as above
  double value = 0;
};

struct StartSummary {
  std::string name;  // the values of the varied parameters, readable
  double cost = 0;   // half the sum of squares of the search; infinite when it failed
  int iterations = 0;
  bool best = false;
};

struct ScanOutcome {
  ScanInfo info;
  Atmosphere<double> atmosphere;
  // Its scale is the profiled one where that is profiled: value / model; NaN without a fitted
  // sample.
  InstrumentState instrument;
  Errors start_errors, errors;
  // That were fitted; without readings of polarisation and irradiances beside a sky.
  int samples = 0, directions = 0;
};

struct Result {
  Likelihood likelihood;
  Pointing pointing = Pointing::kStated;
  double exclude_sun = 0;  // radians
  std::string model_name, start_name, version;
  Transfer transfer = Transfer::kVector;  // of the model
  // As fitted: samples closer to the sun than exclude_sun, where the instrument truly points, have
  // weight 0. Read back from a directory it has no samples.
  refs::Reference reference;
  std::map<std::string, int> samples_left_out;  // by reason
  // The atmosphere of the first scan (of all, unless parameters are per scan), its `fit` member
  // this record.
  Preset preset;
  std::vector<UnknownRow> unknowns;
  std::vector<FixedRow> fixed;
  std::vector<int> covariance_unknowns;  // rows and columns of the matrices: indices of unknowns
  Eigen::MatrixXd covariance;            // in the report's units; empty when singular
  Eigen::MatrixXd correlation;           // empty when singular
  double condition_number = 0;    // of the normal matrix with unit diagonal; infinite when singular
  double sigma_factor = 1;        // on the stated or assumed sigma
  double sigma_percent = 0;       // of a sample, root mean square of sigma / value with the factor
  double effective_samples = 0;   // how many independent ones the samples count as
  double chi_square_per_dof = 0;  // with the factor left out
  Errors start_errors, errors;
  RmsSummary start_rms, rms;
  std::vector<PolarisationErrors> polarisation;  // of each kind that was fitted
  std::vector<IrradianceErrors> irradiances;     // the same, of those beside a sky
  std::vector<ScanOutcome> scans;
  // Per sample of the reference, with the instrument; NaN outside the model's spectra and in a scan
  // without scale.
  std::vector<double> model, start_model;
  // Per sample; NaN where the sample was not fitted. sigma: the assumed one times the root mean
  // square of the whitened residuals, what one sample scatters by.
  std::vector<double> loss_weight, sigma;
  int downweighted = 0;  // samples that the loss leaves less than half their weight
  std::vector<StartSummary> starts;
  bool converged = false;
  std::string termination;  // Ceres' word for it
  // Without readings of polarisation and irradiances beside a sky.
  int samples = 0, directions = 0, iterations = 0, model_evaluations = 0,
      derivative_evaluations = 0;  // of all starts
  double wall_seconds = 0;

  // Throws std::invalid_argument that lists the names when there is no such unknown.
  const UnknownRow& unknown(std::string_view name) const;
};

}  // namespace skyfit::fit
