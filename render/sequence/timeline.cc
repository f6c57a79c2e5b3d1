// SPDX-License-Identifier: Apache-2.0
#include "render/sequence/timeline.h"

#include <fmt/format.h>
#include <tbb/info.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/atmosphere/derived.h"
#include "model/atmosphere/parameters.h"
#include "model/tables/table_blend.h"

namespace skyfit {
namespace {

constexpr double kLargestStep = 1.25;
constexpr int kMostSteps = 12;  // between two given ones
constexpr double kGreen = 550;  // nm

// The amount below which light is linear in it, of a constituent that has some in either
// atmosphere.
double thin_amount(const Atmosphere<double>& a, const Atmosphere<double>& b,
                   const Constituent<double>& c) {
  constexpr double kThin = 0.05;  // vertical optical depth
  const Constituent<double>& other = b.at(c.name);
  const double depth = c.amount > 0 ? vertical_optical_depth(a, c, {kGreen, 0})
                                    : vertical_optical_depth(b, other, {kGreen, 0});
  return std::max(c.amount, other.amount) * std::min(1.0, kThin / depth);
}

// Of the parameter that changes most: its end over its beginning.
double largest_ratio(const Atmosphere<double>& a, const Atmosphere<double>& b) {
  double largest = 1;
  const auto widen = [&](double from, double to) {
    if (std::abs(std::log(to / from)) > std::abs(std::log(largest))) largest = to / from;
  };
  for (const Parameter& parameter : parameters_of(a)) {
    if (!has_parameter(b, parameter)) continue;
    const double from = get_parameter(a, parameter), to = get_parameter(b, parameter);
    if (from > 0 && to > 0) widen(from, to);  // light is linear in what else may be 0
  }
  for (const Constituent<double>& c : a.constituents) {
    const double from = c.amount, to = b.at(c.name).amount;
    if ((from > 0) == (to > 0)) continue;
    const double thin = thin_amount(a, b, c);
    widen(from + thin, to + thin);
  }
  return largest;
}

// Constituents in the order of another atmosphere's, by which tables number phase functions.
TimelineStep in_order_of(const Atmosphere<double>& first, TimelineStep step) {
  std::ranges::stable_sort(step.preset.atmosphere.constituents, {}, [&](const auto& c) {
    const Constituent<double>* const found = first.find(c.name);
    return found != nullptr ? found - first.constituents.data()
                            : static_cast<std::ptrdiff_t>(first.constituents.size());
  });
  return step;
}

// The steps after a, up to b. The shares are such that the ratio of the parameter that changes most
// is the same from step to step.
void add_steps(const TimelineStep& a, const TimelineStep& b, std::vector<TimelineStep>& steps) {
  if (preset_to_json(a.preset) != preset_to_json(b.preset)) {
    const double ratio = largest_ratio(a.preset.atmosphere, b.preset.atmosphere);
    const int count = static_cast<int>(
        std::clamp(std::ceil(std::abs(std::log(ratio)) / std::log(kLargestStep) - 1e-9), 1.0,
                   1.0 * kMostSteps));
    for (int i = 1; i < count; ++i) {
      const double share = std::expm1(std::log(ratio) * i / count) / (ratio - 1);
      steps.push_back(
          {std::lerp(a.time_s, b.time_s, share), preset_between(a.preset, b.preset, share)});
    }
  }
  steps.push_back(b);
}

}  // namespace

Preset preset_between(const Preset& a, const Preset& b, double share) {
  if (share <= 0) return a;
  if (share >= 1) return b;
  Preset preset;
  preset.name = fmt::format("{:.4g} of the way from {} to {}", share, a.name, b.name);
  preset.atmosphere = interpolated_atmosphere(a.atmosphere, b.atmosphere, share);
  return preset;
}

Preset preset_at(const std::vector<TimelineStep>& steps, double time_s) {
  const TimelineMoment moment = moment_at(steps, time_s);
  return preset_between(steps[moment.before].preset, steps[moment.after].preset, moment.share);
}

std::vector<TimelineStep> refined(std::vector<TimelineStep> steps) {
  const Atmosphere<double> first = steps.at(0).preset.atmosphere;
  for (TimelineStep& step : steps) step = in_order_of(first, std::move(step));
  std::vector<TimelineStep> result = {steps[0]};
  for (std::size_t i = 1; i < steps.size(); ++i) {
    try {
      interpolated_atmosphere(steps[i - 1].preset.atmosphere, steps[i].preset.atmosphere, 0.5);
      add_steps(steps[i - 1], steps[i], result);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(fmt::format("presets {} and {} at {:.9g} s and {:.9g} s: {}",
                                              steps[i - 1].preset.name, steps[i].preset.name,
                                              steps[i - 1].time_s, steps[i].time_s, error.what()));
    }
  }
  return result;
}

TimelineMoment moment_at(const std::vector<TimelineStep>& steps, double time_s) {
  const auto next = std::ranges::upper_bound(steps, time_s, {}, &TimelineStep::time_s);
  if (next == steps.begin()) return {0, 0, 0};
  const auto after = static_cast<std::size_t>(next - steps.begin());
  if (next == steps.end()) return {after - 1, after - 1, 0};
  const TimelineStep &a = steps[after - 1], &b = *next;
  const double share = (time_s - a.time_s) / (b.time_s - a.time_s);
  if (share <= 0) return {after - 1, after - 1, 0};
  return {after - 1, after, share};
}

Timeline::Timeline(std::vector<TimelineStep> steps, Compute compute, double first_time_s)
    : steps_(std::move(steps)), compute_(std::move(compute)) {
  // Once, and now: TBB asks how many cores the process may use, and Mesa, while it looks at the
  // processor, binds the main thread to one.
  tbb::info::default_concurrency();
  const TimelineMoment moment = moment_at(steps_, first_time_s);
  tables_of(moment.before);
  tables_of(moment.after);
}

Timeline::Now Timeline::at(double time_s) {
  const TimelineMoment moment = moment_at(steps_, time_s);
  forget_all_but(moment.before, moment.after + 1);
  const Tables before = tables_of(moment.before).get(), after = tables_of(moment.after).get();
  if (moment.after + 1 < steps_.size()) tables_of(moment.after + 1);  // in the background
  const Preset &a = steps_[moment.before].preset, &b = steps_[moment.after].preset;
  if (before == after) return {a, before};
  return {preset_between(a, b, moment.share),
          std::make_shared<AtmosphereTables>(interpolated_tables(*before, *after, moment.share))};
}

std::shared_future<Timeline::Tables> Timeline::tables_of(std::size_t step) {
  const auto same = [&](const Made& made) {
    return made.step == step ||
           preset_to_json(steps_[made.step].preset) == preset_to_json(steps_[step].preset);
  };
  if (const auto found = std::ranges::find_if(made_, same); found != made_.end()) {
    if (found->step != step) made_.push_back({step, std::shared_future(found->tables)});
    return std::ranges::find(made_, step, &Made::step)->tables;
  }
  // One after the other: the model keeps what it prepared last.
  std::vector<std::shared_future<Tables>> earlier;
  for (const Made& made : made_) earlier.push_back(made.tables);
  made_.push_back({step, std::async(std::launch::async, [this, step, earlier]() -> Tables {
                           for (const auto& tables : earlier) tables.wait();
                           return std::make_shared<AtmosphereTables>(compute_(step));
                         }).share()});
  return made_.back().tables;
}

void Timeline::forget_all_but(std::size_t first, std::size_t last) {
  std::erase_if(made_, [&](const Made& made) { return made.step < first || made.step > last; });
}

}  // namespace skyfit
