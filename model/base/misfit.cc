// SPDX-License-Identifier: Apache-2.0
#include "model/base/misfit.h"

#include <fmt/format.h>

#include <cmath>

namespace skyfit {

bool is_factor(double percent) {
  return std::isfinite(percent) && std::abs(percent) > kMostPercent;
}

std::string log_misfit(double percent, int decimals) {
  return is_factor(percent) ? fmt::format("×{:.{}f}", std::exp(percent / 100), decimals)
                            : fmt::format("{:.{}f}", percent, decimals);
}

std::string log_misfit_with_unit(double percent, int decimals) {
  return log_misfit(percent, decimals) + (is_factor(percent) ? "" : " %");
}

}  // namespace skyfit
