// SPDX-License-Identifier: Apache-2.0
#include "render/sequence/table_updates.h"

#include <tbb/task_arena.h>

#include <chrono>
#include <utility>

#include "model/tables/table_blend.h"

namespace skyfit {

TableUpdates::TableUpdates(std::vector<TimelineStep> steps, double frames_per_second,
                           const ColorRule& color,
                           std::function<Atmosphere<double>(const Preset&)> drawn,
                           const BodareUpdateOptions& options, const TableSizes& sizes, int threads)
    : steps_(std::move(steps)),
      frames_per_second_(frames_per_second),
      color_(color),
      drawn_(std::move(drawn)),
      sizes_(sizes),
      threads_(threads),
      update_(drawn_(preset_of(0)), {color.nodes.begin(), color.nodes.end()}, options),
      older_(whole(update_.newer(), preset_of(0))),
      newer_(older_) {}

Preset TableUpdates::preset_of(int frame) const {
  return preset_at(steps_, frame / frames_per_second_);
}

TableUpdates::Whole TableUpdates::whole(const BodareSet& set, const Preset& preset) const {
  return {preset,
          std::make_shared<const AtmosphereTables>(compute_tables_of(
              *set.model(threads_), set.atmosphere(), color_, sizes_, threads_, {}, HeightAxis()))};
}

// The share of the next frame in the next set.
void TableUpdates::advance() {
  if (update_.frame() == 0) next_ = preset_of(frame_);
  tbb::task_arena(threads_).execute([&] { update_.advance(drawn_(next_)); });
  ++frame_;
  if (update_.frame() > 0) return;
  older_ = std::exchange(newer_, whole(update_.newer(), next_));
}

TableUpdates::Now TableUpdates::at(int frame) {
  Now now;
  const auto begin = std::chrono::steady_clock::now();
  while (frame_ <= frame) {
    now.frame = update_.frame();
    now.blend = update_.blend();
    const Whole older = older_, newer = newer_;
    advance();
    if (frame_ <= frame) continue;
    now.preset = preset_between(older.preset, newer.preset, now.blend);
    now.tables = older.tables;
    if (older.tables != newer.tables && now.blend > 0)
      now.tables = now.blend < 1 ? std::make_shared<const AtmosphereTables>(
                                       interpolated_tables(*older.tables, *newer.tables, now.blend))
                                 : newer.tables;
  }
  now.update_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return now;
}

}  // namespace skyfit
