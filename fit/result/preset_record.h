// SPDX-License-Identifier: Apache-2.0
// The fitted preset and its record of what it was fitted to, with which version and how well.
#pragma once

#include <Eigen/Core>
#include <string_view>
#include <vector>

#include "fit/fit.h"

namespace skyfit::fit {

Preset fitted_preset(const Atmosphere<double>& atmosphere, const refs::Reference& reference,
                     const SkyModel& model, const FitOptions& options, const FitResult& result);

// What a fitted preset says of the uncertainty of its parameters: those that were free and not at a
// bound.
struct FittedCovariance {
  std::vector<Parameter> parameters;
  Eigen::MatrixXd matrix;
};

// Throws std::invalid_argument with one line when the preset has none, or one that is not finite;
// `source` is the file name that the message shows.
FittedCovariance fitted_covariance(const Preset& preset, std::string_view source);

// "luminance_cd_m2", "relative_luminance", "spectral_radiance_w_m2_sr_nm"
std::string_view quantity_name(refs::Quantity quantity);

// Numbers that are not finite (no sigma, a singular condition) become null.
nlohmann::json finite_or_null(double value);
nlohmann::json matrix_json(const Eigen::MatrixXd& matrix);  // array of rows; null when empty

}  // namespace skyfit::fit
