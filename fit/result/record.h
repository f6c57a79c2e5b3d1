// SPDX-License-Identifier: Apache-2.0
// The record of a fit: what it was fitted to, how, with which version, how well and how surely. It
// is the `fit` member of the fitted preset and, with the checks, report.json; a Result comes back
// from it.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <string_view>
#include <vector>

#include "fit/result/report.h"
#include "fit/result/result.h"
#include "model/base/preset_reader.h"

namespace skyfit::fit {

// The preset of the first scan with the record of the fit.
Preset fitted_preset(const Result& result);

// The result whose record a preset holds: all but the values per sample. Throws
// std::invalid_argument with one line that names `source`, the file, and the field.
Result result_of(const Preset& preset, std::string_view source);

// The checks of report.json; reading them throws std::invalid_argument as above.
nlohmann::json checks_json(const Result& result, const Checks& checks);
Checks checks_of(const PresetReader& report);

// What a fitted preset says of the uncertainty of its parameters: those that were free, shared by
// all scans and not at a bound.
struct FittedCovariance {
  std::vector<Parameter> parameters;
  Eigen::MatrixXd matrix;
};

// Throws std::invalid_argument with one line when the preset has none, or one that is not finite;
// `source` is the file name that the message shows.
FittedCovariance fitted_covariance(const Preset& preset, std::string_view source);

// Numbers that are not finite (no sigma, a singular condition) become null.
nlohmann::json finite_or_null(double value);
nlohmann::json matrix_json(const Eigen::MatrixXd& matrix);  // array of rows; null when empty

}  // namespace skyfit::fit
