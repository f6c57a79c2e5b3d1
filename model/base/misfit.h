// SPDX-License-Identifier: Apache-2.0
// How far a model is off a reference, as text: percent while it is small, a factor once percents
// say little. Of a logarithm of ratios of 0.04, "4.0 %"; of 0.6, "×1.8", its exponential.
#pragma once

#include <string>

namespace skyfit {

// Above it a misfit is a factor.
inline constexpr double kMostPercent = 50;

// `percent` is 100 ln(model / reference), or a root mean square of that. NaN and infinity are "nan"
// and "inf".
bool is_factor(double percent);
// Without a unit, where a heading or a label behind it says percent: "4.0", or "×1.8".
std::string log_misfit(double percent, int decimals);
// "4.0 %", or "×1.8".
std::string log_misfit_with_unit(double percent, int decimals);

}  // namespace skyfit
