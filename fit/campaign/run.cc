// SPDX-License-Identifier: Apache-2.0
#include "fit/campaign/run.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <new>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

namespace skyfit::fit {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFolder = "tasks";

// Consecutive tasks whose results are one file.
struct Batch {
  fs::path file;
  std::size_t first = 0, count = 0;
  std::vector<std::optional<Outcome>> outcomes;
  std::size_t missing = 0;
};

std::vector<Batch> batches_of(const CampaignRun& run) {
  const auto size = static_cast<std::size_t>(run.plan.tasks_per_file);
  std::vector<Batch> batches;
  for (std::size_t first = 0; first < run.tasks.size(); first += size) {
    batches.push_back({run.directory / kFolder / fmt::format("{:06}.nc", batches.size()),
                       first,
                       std::min(size, run.tasks.size() - first),
                       {},
                       0});
  }
  return batches;
}

// A file that is damaged or not one of ours counts as absent.
std::vector<Outcome> outcomes_in(const fs::path& file) {
  try {
    if (fs::is_regular_file(file)) return outcomes_of(read_netcdf(file), file.string());
  } catch (const std::runtime_error&) {
  }
  return {};
}

bool holds(const std::vector<Outcome>& outcomes, const CampaignRun& run, const Batch& batch) {
  if (outcomes.size() != batch.count) return false;
  for (std::size_t i = 0; i < batch.count; ++i) {
    const Task& task = run.tasks[batch.first + i];
    if (outcomes[i].key != task.key || outcomes[i].task != task.name) return false;
  }
  return true;
}

std::vector<fs::path> result_files(const CampaignRun& run) {
  std::vector<fs::path> files;
  if (!fs::is_directory(run.directory / kFolder)) return files;
  for (const auto& entry : fs::directory_iterator(run.directory / kFolder)) {
    if (entry.path().extension() == ".nc") files.push_back(entry.path());
  }
  std::ranges::sort(files);
  return files;
}

void write(const CampaignRun& run, Batch& batch) {
  std::vector<Outcome> outcomes;
  for (std::optional<Outcome>& outcome : batch.outcomes) outcomes.push_back(std::move(*outcome));
  batch.outcomes.clear();
  write_netcdf(
      batch.file,
      netcdf_of(outcomes, fmt::format("Tasks {} to {} of a campaign of {}", batch.first + 1,
                                      batch.first + batch.count, run.tasks.size())));
}

}  // namespace

void run_campaign(const CampaignRun& run, Shard shard, int threads,
                  const std::function<Outcome(const Task&)>& fit,
                  const std::function<void(std::size_t done, std::size_t all)>& progress) {
  std::vector<Batch> own;
  std::vector<Batch> all = batches_of(run);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (static_cast<int>(i % static_cast<std::size_t>(shard.count)) != shard.index - 1) continue;
    if (!holds(outcomes_in(all[i].file), run, all[i])) own.push_back(std::move(all[i]));
  }
  if (own.empty()) return;
  fs::create_directories(run.directory / kFolder);
  // Where tasks came or went, results have moved to other files.
  std::map<std::pair<std::string, std::string>, Outcome> known;
  for (const fs::path& file : result_files(run)) {
    for (Outcome& outcome : outcomes_in(file)) {
      const std::pair key(outcome.task, outcome.key);
      known.emplace(key, std::move(outcome));
    }
  }
  std::vector<std::pair<Batch*, std::size_t>> pending;
  for (Batch& batch : own) {
    batch.outcomes.resize(batch.count);
    for (std::size_t i = 0; i < batch.count; ++i) {
      const Task& task = run.tasks[batch.first + i];
      const auto found = known.find({task.name, task.key});
      if (found != known.end()) {
        batch.outcomes[i] = std::move(found->second);
      } else {
        ++batch.missing;
        pending.emplace_back(&batch, i);
      }
    }
    if (batch.missing == 0) write(run, batch);
  }
  known.clear();

  std::atomic<std::size_t> next = 0;
  std::mutex mutex;  // over batches, the NetCDF library, and what follows
  std::size_t done = 0;
  std::exception_ptr failure;
  const auto outcome_of_task = [&](const Task& task) {
    try {
      return fit(task);
    } catch (const std::bad_alloc&) {
      throw;  // says nothing of the task
    } catch (const std::exception& error) {
      return failure_of(task, error.what(), run.plan.folder);
    }
  };
  const auto work = [&] {
    try {
      for (std::size_t at = next++; at < pending.size(); at = next++) {
        const auto [batch, i] = pending[at];
        Outcome outcome = outcome_of_task(run.tasks[batch->first + i]);
        const std::lock_guard lock(mutex);
        batch->outcomes[i] = std::move(outcome);
        if (--batch->missing == 0) write(run, *batch);
        progress(++done, pending.size());
      }
    } catch (...) {  // is thrown again by the caller's thread
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      next = pending.size();
    }
  };
  std::vector<std::jthread> workers;
  for (int worker = 1; worker < threads; ++worker) workers.emplace_back(work);
  work();
  workers.clear();  // waits
  if (failure) std::rethrow_exception(failure);
}

std::vector<Outcome> merged(const CampaignRun& run) {
  std::vector<Outcome> all;
  std::size_t missing = 0;
  const std::vector<Batch> batches = batches_of(run);
  for (const Batch& batch : batches) {
    std::vector<Outcome> outcomes = outcomes_in(batch.file);
    if (holds(outcomes, run, batch)) {
      std::ranges::move(outcomes, std::back_inserter(all));
    } else {
      missing += batch.count;
    }
  }
  if (missing > 0)
    throw std::runtime_error(
        fmt::format("{}: the results of {} of {} tasks are missing: expected all shards to have "
                    "run with this plan",
                    (run.directory / kFolder).string(), missing, run.tasks.size()));
  // Of a longer plan before this one.
  for (const fs::path& file : result_files(run)) {
    if (std::ranges::count(batches, file, &Batch::file) == 0) fs::remove(file);
  }
  return all;
}

}  // namespace skyfit::fit
