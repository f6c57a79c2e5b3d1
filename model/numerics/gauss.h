// SPDX-License-Identifier: Apache-2.0
// Gauss-Legendre rules.
#pragma once

#include <vector>

namespace skyfit {

struct GaussRule {
  std::vector<double> node, weight;  // on 0 .. 1, ascending; the weights sum to 1
};
GaussRule gauss_legendre(int order);

}  // namespace skyfit
