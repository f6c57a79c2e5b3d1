// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/variable.h"

#include <cmath>

namespace skyfit::fit {

// docs/theory (11.1).
double Variable::scaled(double value) const {
  return logarithmic ? std::log(value / lower) / std::log(upper / lower)
                     : (value - lower) / (upper - lower);
}

double Variable::value(double scaled) const {
  if (scaled <= 0) return lower;
  if (scaled >= 1) return upper;
  return logarithmic ? lower * std::pow(upper / lower, scaled) : lower + (upper - lower) * scaled;
}

double Variable::value_per_scaled(double scaled) const {
  return logarithmic ? value(scaled) * std::log(upper / lower) : upper - lower;
}

}  // namespace skyfit::fit
