// SPDX-License-Identifier: Apache-2.0
// What `skyfit render` says of what it drew: with --stats all of it, else the device where --gpu or
// --verbose asks.
#pragma once

#include <string>
#include <vector>

#include "cli/render_request.h"
#include "cli/time_account.h"
#include "render/render.h"

namespace skyfit::cli {

// A table with a row per frame, and the medians of its columns below more than one. Written as it
// grows, so that a long sequence can be watched.
class StatisticsTable {
 public:
  // The lines for one more frame, with the table's head before the first and where the passes
  // change.
  std::string row(int frame, const FrameStatistics& statistics);
  // "" for fewer than two frames.
  std::string medians() const;

 private:
  std::vector<std::string> passes_;
  std::vector<std::vector<double>> columns_;  // since the last head
};

// With --stats prints the table's lines, the device and the wall time, and on stderr what kept the
// run from its cache; else the device on stderr, where it is asked for. No device: nothing was
// drawn.
void report_frames(const std::string& lines, const std::string& device, const TimeAccount& time,
                   const RenderRequest& request);

}  // namespace skyfit::cli
