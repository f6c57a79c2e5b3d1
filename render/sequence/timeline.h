// SPDX-License-Identifier: Apache-2.0
// An atmosphere that changes over a sequence. Tables are computed at steps in time, in the
// background while the frames before them are drawn, and interpolated in between.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <vector>

#include "model/atmosphere/preset.h"
#include "model/tables/tables.h"

namespace skyfit {

struct TimelineStep {
  double time_s = 0;
  Preset preset;
};

// Steps between the given ones where a parameter changes by more than a quarter, at most 12: tables
// between two steps are then within 1 % of those of the atmosphere there; of dense layers that
// move, grow or pass each other within some 10 % in and beside them, 30 toward a low sun. An amount
// that is 0 at one end changes from an optical depth of 0.05 on. Ascending in time, constituents in
// the order of the first step's. Throws what interpolated_atmosphere() throws, with the times of
// the two.
std::vector<TimelineStep> refined(std::vector<TimelineStep> steps);

// The steps before and after a time, and the share of the way; the same step twice where nothing
// changes.
struct TimelineMoment {
  std::size_t before = 0, after = 0;
  double share = 0;
};
TimelineMoment moment_at(const std::vector<TimelineStep>& steps, double time_s);

// The preset of a share of the way from one to another, whose atmospheres are comparable.
Preset preset_between(const Preset& a, const Preset& b, double share);

// The preset of a time.
Preset preset_at(const std::vector<TimelineStep>& steps, double time_s);

class Timeline {
 public:
  using Compute = std::function<AtmosphereTables(std::size_t step)>;
  using Tables = std::shared_ptr<const AtmosphereTables>;

  // `compute` is called from another thread, one call at a time, at once for the tables of
  // `first_time_s`.
  Timeline(std::vector<TimelineStep> steps, Compute compute, double first_time_s);

  struct Now {
    Preset preset;
    Tables tables;  // the same object as before where nothing has changed
  };
  // Waits for tables that are not ready. Times may come in any order, ascending ones are cheap.
  // Throws what `compute` throws.
  Now at(double time_s);

  // The preset of all times; null where it changes.
  const Preset* steady() const { return steps_.size() == 1 ? &steps_[0].preset : nullptr; }
  void forget() { made_.clear(); }  // tables, until they are asked for again

 private:
  struct Made {
    std::size_t step;
    std::shared_future<Tables> tables;
  };
  std::shared_future<Tables> tables_of(std::size_t step);
  void forget_all_but(std::size_t first, std::size_t last);

  std::vector<TimelineStep> steps_;
  Compute compute_;
  std::vector<Made> made_;
};

}  // namespace skyfit
