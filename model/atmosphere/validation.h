// SPDX-License-Identifier: Apache-2.0
// What the parts of validate(Atmosphere) share: complaints of one line that begin with the path of
// a field.
#pragma once

#include <string_view>

#include "model/atmosphere/atmosphere.h"

namespace skyfit {

// Throws std::invalid_argument, `path = value: expected expectation`, unless the value is finite
// and `holds`.
void expect(bool holds, std::string_view path, double value, std::string_view expectation);

// The path of an amount inside its constituent.
std::string_view amount_path(AmountType type);

// The highest coefficient and the thickest atmosphere that the solver was tried with.
inline constexpr double kMostCoefficient = 10;  // 1/m
inline constexpr double kMostDepth = 1000;      // vertical optical depth

// Throws where coefficients, optical depths and phase functions are each what an atmosphere may
// have and together more than the solver can do. All else about the atmosphere is valid.
void validate_solver_limits(const Atmosphere<double>& atmosphere);

}  // namespace skyfit
