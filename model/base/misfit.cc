// SPDX-License-Identifier: Apache-2.0
#include "model/base/misfit.h"

#include <fmt/format.h>

#include <cmath>

namespace skyfit {

bool is_factor(double percent) {
  return std::isfinite(percent) && std::abs(percent) > kMostPercent;
}

std::string log_misfit(double percent, int decimals) {
  return is_factor(percent) ? log_misfit_digits(percent, decimals + 1)
                            : fmt::format("{:.{}f}", percent, decimals);
}

std::string log_misfit_digits(double percent, int digits) {
  if (is_factor(percent)) return fmt::format("×{:.{}g}", std::exp(percent / 100), digits);
  return std::isfinite(percent) ? fmt::format("{:.{}g}", percent, digits) : "-";
}

std::string log_misfit_digits_with_unit(double percent, int digits) {
  return log_misfit_digits(percent, digits) + (is_factor(percent) ? "" : " %");
}

std::string log_misfit_with_unit(double percent, int decimals) {
  return log_misfit(percent, decimals) + (is_factor(percent) ? "" : " %");
}

}  // namespace skyfit
