// SPDX-License-Identifier: Apache-2.0
// The problem of least squares behind a fit: data, unknowns and likelihood.
#pragma once

#include <vector>

#include "fit/problem/likelihood.h"
#include "fit/problem/options.h"
#include "fit/problem/starts.h"
#include "fit/problem/unknowns.h"
#include "fit/solve/least_squares.h"

namespace skyfit::fit {

inline constexpr int kMediumChannels = 12;  // wavelengths of hold-outs

class Evaluations;

struct Problem {
  const SkyModel* model;
  Likelihood likelihood;
  Dataset fitted;  // the samples that are fitted
  Dataset medium;  // some wavelengths of them, for hold-outs
  Dataset coarse;  // few wavelengths of them, or a coarse rule of luminance, for a search
  Dataset all;     // every sample of the reference
  SkyState given;  // as the options say
  SkyState start;  // the first of the starts
  std::vector<Unknown> unknowns;
  std::vector<Start> starts;
  std::vector<std::string> assumptions;  // notes for the report, one line each
  bool lobes_may_swap = false;           // exchanging them leaves the problem as it is

  int scans() const { return static_cast<int>(fitted.scans.size()); }
  int profiled_scales() const;  // of the fitted scans
  SkyState state(const Eigen::VectorXd& scaled) const;
  // The same sky with g1 > g2 where the lobes may swap.
  Eigen::VectorXd with_ordered_lobes(const Eigen::VectorXd& scaled) const;
  // Where the scale is profiled, the state with that of each scan in `data`; NaN without a sample.
  SkyState with_profiled_scales(SkyState state, const Dataset& data) const;
  Minimum solve(const Dataset& data, const Eigen::VectorXd& start_scaled, double factor,
                const SolverLimits& limits) const;
  // The same where others ask for the same points: `evaluations` are of this problem.
  Minimum solve(Evaluations& evaluations, const Eigen::VectorXd& start_scaled, double factor,
                const SolverLimits& limits) const;
  // What the loss leaves of the weight of each sample, 0 .. 1, the same within a line of sight.
  // `residual`: whitened, of `data`.
  Eigen::VectorXd loss_weights(const Dataset& data, const Eigen::VectorXd& residual) const;
};

// The model's values of a dataset at the latest points, for the next solution begins where the last
// one ended. Both outlive it.
class Evaluations {
 public:
  Evaluations(const Problem& problem, const Dataset& data) : problem_(problem), data_(data) {}
  // Throws std::domain_error where the point is no possible sky.
  SampleValues at(const Eigen::VectorXd& scaled, bool with_derivatives);
  const Dataset& data() const { return data_; }
  int values_computed() const { return values_computed_; }  // without derivatives
  int derivatives_computed() const { return derivatives_computed_; }

 private:
  struct Point {
    Eigen::VectorXd scaled;
    bool with_derivatives;
    SampleValues values;
  };
  const Problem& problem_;
  const Dataset& data_;
  std::vector<Point> latest_;  // at most kKept, the last one last
  int values_computed_ = 0, derivatives_computed_ = 0;
};

// Throws std::invalid_argument as fit_atmosphere() does.
Problem make_problem(const refs::Reference& reference, const SpectralData& spectra,
                     const SkyModel& model, const FitOptions& options);

// The model's value of every sample of the reference, with the instrument; NaN outside the model's
// spectra.
std::vector<double> reference_values(const Problem& problem, const SkyState& state,
                                     std::size_t samples);

// The options for a reference whose samples near the sun have weight 0 already.
FitOptions without_sun_exclusion(FitOptions options);

}  // namespace skyfit::fit
