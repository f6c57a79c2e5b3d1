// SPDX-License-Identifier: Apache-2.0
// Interpolation by a polynomial through a few nodes.
#pragma once

namespace skyfit {

// Lagrange's weights at x for `count` nodes: f(x) = sum weights[i] f(nodes[i]).
void lagrange_weights(const double* nodes, int count, double x, double* weights);

}  // namespace skyfit
