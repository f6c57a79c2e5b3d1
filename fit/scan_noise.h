// SPDX-License-Identifier: Apache-2.0
// How many independent samples the residuals of scans are worth: neighbouring directions and
// neighbouring wavelengths of a misfit agree.
//
// N_eff = (independent directions) * (independent wavelengths of a direction). The directions are
// counted by the exponentially correlated field of noise.h over the directions' mean residuals; the
// wavelengths by the correlation r of neighbours: n^2 / sum_ij r^|i - j|. White noise gives N.
#pragma once

#include <Eigen/Core>

#include "fit/scan_data.h"

namespace skyfit::fit {

struct ScanNoise {
  double factor;             // on the sigma of the residuals; > 0
  double effective_samples;  // 1 .. rows
};

// `residual`: whitened, one per row.
ScanNoise scan_noise(const ScanData& data, const Eigen::VectorXd& residual, int unknowns);

}  // namespace skyfit::fit
