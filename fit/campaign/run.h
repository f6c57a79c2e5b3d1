// SPDX-License-Identifier: Apache-2.0
// Runs the tasks of a campaign. Results are written in files of tasks_per_file tasks, each complete
// or absent, DIR/tasks/000000.nc and on; what is there already is not done again.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "fit/campaign/outcome.h"
#include "fit/campaign/plan.h"

namespace skyfit::fit {

// The files whose number leaves index - 1 when divided by count: one of `count` machines.
struct Shard {
  int index = 1, count = 1;
};

struct CampaignRun {
  const CampaignPlan& plan;
  const std::vector<Task>& tasks;
  std::filesystem::path directory;
};

// Calls fit(task) and progress(done, all) from `threads` threads. A std::exception of a fit becomes
// the outcome's reason; that memory is short, and anything else that is thrown, ends the campaign
// and leaves it. Throws std::runtime_error when results cannot be written.
void run_campaign(const CampaignRun& run, Shard shard, int threads,
                  const std::function<Outcome(const Task&)>& fit,
                  const std::function<void(std::size_t done, std::size_t all)>& progress);

// The outcomes of all tasks, in their order. Throws std::runtime_error that says how many are
// missing.
std::vector<Outcome> merged(const CampaignRun& run);

}  // namespace skyfit::fit
