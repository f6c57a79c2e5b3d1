// SPDX-License-Identifier: Apache-2.0
// The fitted preset and its record of what it was fitted to, with which version and how well.
#pragma once

#include "fit/fit.h"

namespace skyfit::fit {

Preset fitted_preset(const Atmosphere<double>& atmosphere, const refs::Reference& reference,
                     const SkyModel& model, const FitOptions& options, const FitResult& result);

// Numbers that are not finite (no sigma, a singular condition) become null.
nlohmann::json finite_or_null(double value);
nlohmann::json matrix_json(const Eigen::MatrixXd& matrix);  // array of rows; null when empty

}  // namespace skyfit::fit
