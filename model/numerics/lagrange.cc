// SPDX-License-Identifier: Apache-2.0
#include "model/numerics/lagrange.h"

#include <cstddef>

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

NodeRange without_short_steps(std::span<const double> nodes, int above, NodeRange range) {
  constexpr double kLeastShare = 0.25;
  const auto length = [&](int end) {
    return nodes[static_cast<std::size_t>(end)] - nodes[static_cast<std::size_t>(end - 1)];
  };
  const double least = kLeastShare * length(above);
  int first = range.first, end = range.first + range.count;
  while (end > above + 1 && length(end - 1) < least) --end;
  while (first < above - 1 && length(first + 1) < least) ++first;
  return {first, end - first};
}

}  // namespace skyfit
