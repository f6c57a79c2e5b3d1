// SPDX-License-Identifier: Apache-2.0
// Where the wall time of a run went, from the start of the process on.
#pragma once

#include <chrono>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "render/render.h"

namespace skyfit::cli {

class TimeAccount {
 public:
  // What passed before is the step "start": loading the program, reading its input.
  TimeAccount();

  // What has passed since the last call was this step. Steps of one name add up.
  void done(std::string_view step);

  // The same, which `parts` say more of; what they leave of it is the step.
  void done(std::string_view step, std::span<const PassTime> parts);

  // A row for each step in the order of their first time, with its share; the last but one is the
  // rest, which no step has, the last the sum.
  std::string table() const;

 private:
  using Clock = std::chrono::steady_clock;
  void add(std::string_view step, double seconds);
  double elapsed();  // since the last call

  const double before_s_;  // this object was made
  const Clock::time_point made_ = Clock::now();
  Clock::time_point last_ = made_;
  std::vector<std::pair<std::string, double>> steps_;  // s
};

}  // namespace skyfit::cli
