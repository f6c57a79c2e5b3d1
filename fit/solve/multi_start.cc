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
  Solution solution;
  std::exception_ptr failure;
};

Attempt attempt(const Problem& problem, const Start& start, const SolverLimits& limits) {
  Attempt result;
  try {
    result.solution = minimise(problem, start.atmosphere, limits);
  } catch (...) {
    result.failure = std::current_exception();
    result.solution.cost = std::numeric_limits<double>::infinity();
  }
  return result;
}

MultiStart summarise(const std::vector<Start>& starts, const std::vector<Attempt>& attempts) {
  const auto best = std::min_element(
      attempts.begin(), attempts.end(),
      [](const Attempt& a, const Attempt& b) { return a.solution.cost < b.solution.cost; });
  if (best->failure) std::rethrow_exception(best->failure);
  MultiStart result;
  result.best = best->solution;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    const Solution& solution = attempts[i].solution;
    result.summaries.push_back(
        {starts[i].name, solution.cost, solution.iterations, &attempts[i] == &*best});
    result.iterations += solution.iterations;
    result.evaluations += solution.evaluations;
    result.derivative_evaluations += solution.derivative_evaluations;
  }
  return result;
}

}  // namespace

MultiStart solve_from(const std::vector<Start>& starts, const Problem& problem,
                      const SolverLimits& limits, int threads,
                      const std::function<void(double)>& progress) {
  std::vector<Attempt> attempts(starts.size());
  std::atomic<std::size_t> next = 0;
  std::mutex progress_mutex;
  std::size_t finished = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < starts.size(); i = next++) {
      attempts[i] = attempt(problem, starts[i], limits);
      const std::lock_guard lock(progress_mutex);
      ++finished;
      if (progress) progress(static_cast<double>(finished) / static_cast<double>(starts.size()));
    }
  };
  {
    std::vector<std::jthread> workers;
    const std::size_t count =
        std::min<std::size_t>(starts.size(), static_cast<std::size_t>(threads));
    for (std::size_t k = 1; k < count; ++k) workers.emplace_back(work);
    work();
  }
  return summarise(starts, attempts);
}

}  // namespace skyfit::fit
