// SPDX-License-Identifier: Apache-2.0
// Solves from several starts at once and keeps the best.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fit/problem/solver.h"
#include "fit/problem/starts.h"

namespace skyfit::fit {

struct MultiStart {
  std::vector<StartSummary> summaries;  // in the order of the starts
  Solution best;
  int iterations = 0, evaluations = 0, derivative_evaluations = 0;  // of all starts
};

// `threads` starts are solved at the same time; the result does not depend on it. A start whose
// solution fails has an infinite cost; when all fail, the first failure is thrown. `progress` gets
// the finished share, from one thread at a time.
MultiStart solve_from(const std::vector<Start>& starts, const Problem& problem,
                      const SolverLimits& limits, int threads,
                      const std::function<void(double)>& progress);

}  // namespace skyfit::fit
