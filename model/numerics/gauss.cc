// SPDX-License-Identifier: Apache-2.0
#include "model/numerics/gauss.h"

#include <cmath>
#include <numbers>

namespace skyfit {

GaussRule gauss_legendre(int order) {
  GaussRule rule{std::vector<double>(order), std::vector<double>(order)};
  for (int i = 0; i < order; ++i) {
    double x = std::cos(std::numbers::pi * (i + 0.75) / (order + 0.5));
    double slope = 1;
    for (int iteration = 0; iteration < 8;
         ++iteration) {  // Newton's method, quadratic from a good guess
      double p0 = 1, p1 = x;
      for (int n = 2; n <= order; ++n) {
        const double p2 = ((2 * n - 1) * x * p1 - (n - 1) * p0) / n;
        p0 = p1;
        p1 = p2;
      }
      slope = order * (x * p1 - p0) / (x * x - 1);
      x -= p1 / slope;
    }
    rule.node[order - 1 - i] = 0.5 * (1 + x);
    rule.weight[order - 1 - i] = 1 / ((1 - x * x) * slope * slope);
  }
  return rule;
}

}  // namespace skyfit
