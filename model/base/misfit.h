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
// Without a unit, where a heading or a label behind it says percent: "4.0", or "×1.8", which has
// one significant digit more than the percent has decimals.
std::string log_misfit(double percent, int decimals);
// The same with so many significant digits in the place of decimals; "-" where it is not known.
std::string log_misfit_digits(double percent, int digits);
// "4.0 %", or "×1.8".
std::string log_misfit_with_unit(double percent, int decimals);
std::string log_misfit_digits_with_unit(double percent, int digits);

}  // namespace skyfit
