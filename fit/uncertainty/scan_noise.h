// SPDX-License-Identifier: Apache-2.0
// What the residuals of scans say of their noise. The misfit of a smooth sky by another agrees
// between neighbouring directions and wavelengths: within a scan its correlation is taken as
// exp(-angle / length) * r^(wavelengths between), between scans as 0; length follows from the
// directions' mean residuals (noise.h), r from neighbouring wavelengths of a direction.
//
// N_eff = N * (share of independent directions) * (share of independent wavelengths): of n, n^2
// over the sum of the correlations of all pairs. White noise gives N.
#pragma once

#include <Eigen/Core>

#include "fit/problem/scan_data.h"

namespace skyfit::fit {

struct ScanNoise {
  // On the sigma of the residuals: independent_factor / sqrt(share of independent wavelengths).
  double factor = 1;
  double independent_factor = 1;      // sqrt(chi^2 / degrees of freedom)
  double effective_samples = 0;       // 1 .. rows
  double length = 0;                  // radians
  double wavelength_correlation = 0;  // r
};

// `residual`: whitened, one per row.
ScanNoise scan_noise(const ScanData& data, const Eigen::VectorXd& residual, int unknowns);

// The correlation matrix of the rows times `columns`, [row][.].
Eigen::MatrixXd times_correlation(const ScanData& data, const ScanNoise& noise,
                                  const Eigen::MatrixXd& columns);

}  // namespace skyfit::fit
