// SPDX-License-Identifier: Apache-2.0
#include "model/numerics/lagrange.h"

namespace skyfit {

// docs/theory (3.3).
void lagrange_weights(const double* nodes, int count, double x, double* weights) {
  for (int i = 0; i < count; ++i) {
    weights[i] = 1;
    for (int k = 0; k < count; ++k) {
      if (k != i) weights[i] *= (x - nodes[k]) / (nodes[i] - nodes[k]);
    }
  }
}

}  // namespace skyfit
