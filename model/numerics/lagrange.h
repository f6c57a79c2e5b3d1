// SPDX-License-Identifier: Apache-2.0
// Interpolation by a polynomial through a few nodes.
#pragma once

#include <span>

namespace skyfit {

// Lagrange's weights at x for `count` nodes: f(x) = sum weights[i] f(nodes[i]).
void lagrange_weights(const double* nodes, int count, double x, double* weights);

// Nodes that an interpolation uses: `count` of them from `first` on.
struct NodeRange {
  int first, count;
};

// Of a range about the step from nodes[above - 1] to nodes[above] the part without steps shorter
// than a quarter of it. Where a layer ends, levels lie close together and light has a kink: a cubic
// through two of them would go astray over the long step beside them.
NodeRange without_short_steps(std::span<const double> nodes, int above, NodeRange range);

}  // namespace skyfit
