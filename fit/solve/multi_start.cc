// SPDX-License-Identifier: Apache-2.0
#include "fit/solve/multi_start.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <limits>
#include <mutex>
#include <thread>

namespace skyfit::fit {
namespace {

struct Attempt {
  Minimum minimum;
  std::exception_ptr failure;
};

Attempt attempt(const std::function<Minimum(std::size_t)>& solve, std::size_t start) {
  Attempt result;
  try {
    result.minimum = solve(start);
  } catch (...) {
    result.failure = std::current_exception();
    result.minimum.cost = std::numeric_limits<double>::infinity();
  }
  return result;
}

MultiStart best_of(const std::vector<Attempt>& attempts) {
  const auto best =
      std::ranges::min_element(attempts, {}, [](const Attempt& a) { return a.minimum.cost; });
  if (best->failure) std::rethrow_exception(best->failure);
  MultiStart result;
  for (const Attempt& one : attempts) result.minima.push_back(one.minimum);
  result.best = static_cast<std::size_t>(best - attempts.begin());
  return result;
}

}  // namespace

MultiStart solve_from(std::size_t starts, const std::function<Minimum(std::size_t)>& solve,
                      int threads, const std::function<void(double)>& progress) {
  std::vector<Attempt> attempts(starts);
  std::atomic<std::size_t> next = 0;
  std::mutex progress_mutex;
  std::size_t finished = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < starts; i = next++) {
      attempts[i] = attempt(solve, i);
      const std::lock_guard lock(progress_mutex);
      ++finished;
      if (progress) progress(static_cast<double>(finished) / static_cast<double>(starts));
    }
  };
  {
    std::vector<std::jthread> workers;
    const std::size_t count = std::min(starts, static_cast<std::size_t>(threads));
    for (std::size_t k = 1; k < count; ++k) workers.emplace_back(work);
    work();
  }
  return best_of(attempts);
}

}  // namespace skyfit::fit
