// SPDX-License-Identifier: Apache-2.0
// One unknown as the solver sees it: a pure number in 0..1 in its place, logarithmic or linear
// between its bounds, 0 at the lower and 1 at the upper one.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "model/atmosphere/parameters.h"

namespace skyfit::fit {

struct Variable {
  double lower, upper;         // in the unknown's unit
  bool logarithmic;            // requires lower > 0
  std::optional<Prior> prior;  // in the unknown's unit

  double scaled(double value) const;
  double value(double scaled) const;
  double value_per_scaled(double scaled) const;  // d value / d scaled
};

}  // namespace skyfit::fit
