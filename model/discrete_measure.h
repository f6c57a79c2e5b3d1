// SPDX-License-Identifier: Apache-2.0
// Polynomials that are orthogonal under a sum of weighted points, and what follows from them: Gauss
// rules for such a sum and weighted least-squares polynomials. Source: Gautschi 2004, Orthogonal
// Polynomials, sections 2.2.3.1 (Stieltjes' procedure) and 3.1.1 (Golub & Welsch).
#pragma once

#include <vector>

namespace skyfit {

// Points in any order, weights >= 0 with at least as many positive ones as the degrees asked for
// below.
struct DiscreteMeasure {
  std::vector<double> point;
  std::vector<double> weight;
};

// sum_k weight[k] f(node[k]) equals the measure's sum for polynomials up to degree 2 n - 1. Nodes
// ascend, between the outermost points; weights are positive. n >= 1, well below the number of
// points (Stieltjes' procedure loses orthogonality near it).
struct GaussRule {
  std::vector<double> node;
  std::vector<double> weight;
};
GaussRule gauss_rule(const DiscreteMeasure& measure, int n);

// Values at `where` of the polynomial of `degree` that is nearest to `values` (one per point) in
// weighted squares.
std::vector<double> least_squares_polynomial(const DiscreteMeasure& measure,
                                             const std::vector<double>& values, int degree,
                                             const std::vector<double>& where);

}  // namespace skyfit
