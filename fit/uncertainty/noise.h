// SPDX-License-Identifier: Apache-2.0
// The noise of a reference that does not state its own.
//
// sigma_log^2 = sum(weight d^2) / sum(weight) * N / (N - scans - parameters) * N / N_eff,
// d the logarithmic residuals with their scans' means subtracted. The misfit of a smooth sky by
// another is not noise: neighbouring residuals agree, and counting each as independent would let
// the misfit override every prior. N_eff counts the independent ones. The residuals are taken as an
// exponentially correlated field, correlation(angle) = exp(-angle / length) within a scan and 0
// between scans, whose length follows from the correlation of nearest neighbours; the mean of a
// scan of n then counts as n^2 / sum_ij exp(-angle_ij / length) samples. White noise gives N.
#pragma once

#include "fit/problem/observations.h"

namespace skyfit::fit {

// Where sigma_log starts before there are residuals, and the floor below which the model's own
// numerics speak.
inline constexpr double kFirstSigmaLog = 0.10;
inline constexpr double kSmallestSigmaLog = 1e-3;

struct Noise {
  double sigma_log;          // >= kSmallestSigmaLog; factor on observations.sigma_log
  double effective_samples;  // 1 .. count
};

// `residual`: log(model) - log(reference) + log(scale) per sample, over observations.sigma_log.
Noise estimate_noise(const Observations& observations, const Eigen::VectorXd& residual,
                     int free_parameters);

// The length of that field, radians; 0 where neighbours do not agree.
double correlation_length(const Observations& observations, const Eigen::VectorXd& residual);
// exp(-angle / length) between the view directions of points; the unit matrix for a length of 0.
Eigen::MatrixXd angular_correlation(const std::vector<SkyPoint>& points, double length);

}  // namespace skyfit::fit
