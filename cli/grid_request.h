// SPDX-License-Identifier: Apache-2.0
// What --strip and --rows of `skyfit render` ask for: a request for each frame of a grid. A
// quantity of an axis is a parameter of the preset, or an option, which each frame then has as if
// its value had been typed.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cli/render_request.h"
#include "render/sequence/grid.h"

namespace skyfit::cli {

struct GridRequest {
  GridAxis columns, rows;
  std::vector<RenderRequest> cells;  // row by row
  // Of each cell: cells of the same name are drawn by one renderer with one model.
  std::vector<std::string> sessions;
  bool meters_together = true;  // or each frame by itself
};

// "altitude-m, .. or model", for help texts and messages.
std::string axis_options();

// Throws UsageError that names --strip or --rows where a value of theirs is at fault, and what
// frame_request() throws.
GridRequest grid_request(const RenderOptions& options, const CLI::App& command);

}  // namespace skyfit::cli
