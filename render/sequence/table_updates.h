// SPDX-License-Identifier: Apache-2.0
// An atmosphere that changes over a sequence, whose tables the model `bodare` renews over frames:
// Bodare & Sandberg 2014, chapter 5. While the frames of one update are drawn, the picture goes
// over from the set before the last to the last whole one; it lags behind the sequence by one
// update to three, and a set that is not whole is never shown.
#pragma once

#include <memory>
#include <vector>

#include "model/literature/bodare_update.h"
#include "render/sequence/timeline.h"

namespace skyfit {

class TableUpdates {
 public:
  // `drawn` makes of a preset's atmosphere that of the frames. The first set is made at once, of
  // the first frame. Throws what BodareUpdate throws.
  TableUpdates(std::vector<TimelineStep> steps, double frames_per_second, const ColorRule& color,
               std::function<Atmosphere<double>(const Preset&)> drawn,
               const BodareUpdateOptions& options, const TableSizes& sizes, int threads);

  struct Now {
    Preset preset;            // between those of the two sets
    Timeline::Tables tables;  // the same object as before where nothing has changed
    double blend = 1;         // weight of the newer set
    int frame = 0;            // of the update, from 0
    double update_ms = 0;     // by the wall clock, what this frame did for the next set
  };
  // Frames ascend. What frames that are left out would have done is done as well.
  Now at(int frame);

  int frames_of_update() const { return update_.frames_of_update(); }

 private:
  // A whole set as a renderer wants it, and the preset it was made of.
  struct Whole {
    Preset preset;
    Timeline::Tables tables;
  };
  Preset preset_of(int frame) const;
  void advance();
  Whole whole(const BodareSet& set, const Preset& preset) const;

  std::vector<TimelineStep> steps_;
  double frames_per_second_;
  ColorRule color_;
  std::function<Atmosphere<double>(const Preset&)> drawn_;
  TableSizes sizes_;
  int threads_;
  BodareUpdate update_;
  Whole older_, newer_;
  Preset next_;    // of the set that is being built
  int frame_ = 0;  // the next that is not done
};

}  // namespace skyfit
