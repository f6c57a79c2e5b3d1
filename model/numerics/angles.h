// SPDX-License-Identifier: Apache-2.0
// Factors between the degrees that people write and the radians of the formulas.
#pragma once

#include <numbers>

namespace skyfit {

inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;
inline constexpr double kDegreesPerRadian = 180 / std::numbers::pi;

}  // namespace skyfit
