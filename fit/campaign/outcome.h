// SPDX-License-Identifier: Apache-2.0
// What a campaign keeps of a fit, and its form in NetCDF and CSV.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "fit/campaign/plan.h"
#include "fit/exchange/netcdf_file.h"
#include "fit/result/result.h"

namespace skyfit::fit {

struct Outcome {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  std::string task, key;
  std::string reason;  // why there is no fit, one line; empty: there is one
  // Of the first scan; seconds since 1970, degrees, metres. NaN: not known.
  double time = kNone, latitude = kNone, longitude = kNone, elevation = kNone, sun_zenith = kNone;
  double scans = 0, samples = 0, converged = 0;
  // Percent, as in Errors, and what the noise was multiplied with.
  double rms_log = kNone, luminance = kNone, spectral = kNone, bias = kNone, sigma_factor = kNone;
  double chi_square_per_dof = kNone;
  struct Value {
    std::string name, unit;  // of the report
    double value, sigma;     // sigma NaN at a bound
    int at_bound, identifiable;
  };
  std::vector<Value> unknowns;
  std::vector<std::string> covariance_names;
  Eigen::MatrixXd covariance;

  // The error that the fit made small: of spectra, else of luminances, else of their logarithms.
  double misfit() const;
};

// Its time as "2013-05-27T13:30:00Z"; empty where it is not known.
std::string iso_time(const Outcome& outcome);

Outcome outcome_of(const Task& task, const Result& result);
// Paths in the reason become those from `folder`, the plan's, wherever the campaign was started.
Outcome failure_of(const Task& task, std::string reason, const std::filesystem::path& folder);

// Dimensions task, parameter and covariance_parameter, of all unknowns that any task has.
NetcdfFile netcdf_of(const std::vector<Outcome>& outcomes, std::string_view title);
// Throws std::runtime_error with one line where the file is no such file.
std::vector<Outcome> outcomes_of(const NetcdfFile& file, std::string_view source);

// Fits whose misfit lies more than five robust standard deviations (1.4826 times the median of the
// distances from the median) above the median; one flag per outcome.
std::vector<int> outliers(const std::vector<Outcome>& outcomes);

// One line per task: state (fitted, outlier, failed), reason, numbers, and value and sigma of every
// unknown.
std::string campaign_csv(const std::vector<Outcome>& outcomes);

// How many were fitted, how well, mean and scatter of every unknown, the outliers and what failed.
std::string campaign_text(const std::vector<Outcome>& outcomes);

}  // namespace skyfit::fit
