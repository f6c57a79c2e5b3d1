// SPDX-License-Identifier: Apache-2.0
// What the residuals say of the noise. The misfit of a smooth sky by another is not noise: it
// agrees between neighbouring directions and wavelengths, and counting each sample as independent
// would let the misfit override every prior. Within a scan the correlation is taken as
// exp(-angle / length) * r^(wavelengths between), between scans as 0. length follows from nearest
// neighbours among the lines of sight (their mean residuals), r from neighbouring wavelengths of a
// line of sight.
//
// Readings of polarisation count among the samples but not in length and r; between them and
// radiances the correlation is taken as 0, among those of one kind as among radiances. Irradiances
// beside a sky say nothing of its noise and do not count.
//
// N_eff = N * (share of independent lines of sight) * (share of independent wavelengths): of n, n^2
// over the sum of the correlations of all pairs. White noise gives N.
//
// The factor on sigma with which the fit weighs data against priors is
//   independent_factor = sqrt(chi^2 / (N - determined - profiled scales))
// with the samples and their squares as the loss weighs them and the number of unknowns that the
// data determine beside the priors (covariance.h),
// over the square root of a share: under the log link of N_eff / N; under the linear link of the
// independent wavelengths alone, and the covariance allows for the lines of sight (covariance.h).
// The two links differ because their noise does: a standard sky has none, so that all of its misfit
// is systematic and must yield to priors; an instrument's is mostly its own.
#pragma once

#include <Eigen/Core>

#include "fit/problem/likelihood.h"

namespace skyfit::fit {

// Under the log link and unknown noise: sigma of a sample before there are residuals, and the floor
// below which the model's own numerics speak; relative.
inline constexpr double kFirstSigma = 0.10;
inline constexpr double kSmallestSigma = 1e-3;

struct Noise {
  double factor = 1;                  // on sigma, see above
  double independent_factor = 1;      // see above
  double effective_samples = 0;       // N_eff, 1 .. N
  double length = 0;                  // radians; 0 where neighbours do not agree
  double wavelength_correlation = 0;  // r
};

// `residual`: whitened with a factor of 1, one per sample, as are `weights`, what the loss leaves.
// `determined`: with the profiled scales.
Noise estimate_noise(const Dataset& data, const Likelihood& likelihood,
                     const Eigen::VectorXd& residual, const Eigen::VectorXd& weights,
                     double determined);

// The correlation matrix of the samples, which are those of a sky, times `columns`, [sample][.].
Eigen::MatrixXd times_correlation(const Dataset& data, const Noise& noise,
                                  const Eigen::MatrixXd& columns);

}  // namespace skyfit::fit
