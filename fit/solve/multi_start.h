// SPDX-License-Identifier: Apache-2.0
// Solves from several starts at once and keeps the best.
#pragma once

#include <functional>
#include <vector>

#include "fit/solve/least_squares.h"

namespace skyfit::fit {

struct MultiStart {
  std::vector<Minimum> minima;  // in the order of the starts; of infinite cost where it failed
  std::size_t best = 0;
};

// Calls `solve` with 0 .. starts - 1, `threads` at the same time; the result does not depend on
// it. A start whose solution throws has an infinite cost; when all do, the first exception is
// thrown. `progress` gets the finished share, from one thread at a time; it may be empty.
MultiStart solve_from(std::size_t starts, const std::function<Minimum(std::size_t)>& solve,
                      int threads, const std::function<void(double)>& progress);

}  // namespace skyfit::fit
