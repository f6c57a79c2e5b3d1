// SPDX-License-Identifier: Apache-2.0
// The problem of least squares behind a fit of measured skies.
#pragma once

#include <vector>

#include "fit/measured.h"
#include "fit/problem/scan_model.h"
#include "fit/problem/starts.h"
#include "fit/solve/least_squares.h"

namespace skyfit::fit {

inline constexpr int kMediumChannels = 12;  // wavelengths of what is repeated

// (model - measured) / (factor sigma) per row.
struct Whitened {
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian_per_unit;  // [row][unknown], per unit of the unknown
};

struct MeasuredProblem {
  const SkyModel* model;
  ScanData fitted;  // the samples that are fitted
  ScanData medium;  // some wavelengths of them, for what is repeated
  ScanData coarse;  // few wavelengths of them, for the search among the starts
  ScanData all;     // every sample of the reference
  SkyState start;
  std::vector<Unknown> unknowns;
  std::vector<Start> starts;
  Loss loss = Loss::kNone;
  double loss_width = 3;

  int scans() const { return static_cast<int>(fitted.scans.size()); }
  SkyState state(const Eigen::VectorXd& scaled) const;
  Whitened whitened(const ScanData& data, const RowValues& values, double factor) const;
  Eigen::VectorXd residuals(const ScanData& data, const Eigen::VectorXd& scaled,
                            double factor) const;
  Minimum solve(const ScanData& data, const Eigen::VectorXd& start_scaled, double factor,
                const SolverLimits& limits) const;
  // What the loss leaves of each look's weight.
  std::vector<double> loss_weights(const Eigen::VectorXd& residual) const;
};

// Throws std::invalid_argument as fit_measured() does.
MeasuredProblem measured_problem(const refs::Reference& reference, const SpectralData& spectra,
                                 const SkyModel& model, const MeasuredOptions& options);

// The model's value of every sample of the reference, with the instrument.
std::vector<double> sample_values(const MeasuredProblem& problem, const SkyState& state,
                                  std::size_t samples);

// The options for a reference whose samples near the sun have weight 0 already.
MeasuredOptions as_pointed(MeasuredOptions options);

// The preset of the first scan with the record of the fit.
Preset measured_preset(const refs::Reference& reference, const SkyModel& model,
                       const MeasuredOptions& options, const MeasuredResult& result);

}  // namespace skyfit::fit
