// SPDX-License-Identifier: Apache-2.0
// The figure's one legend, in one row.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/plot/script.h"

namespace skyfit::plot {

enum class Mark { kSolidLine, kDashedLine, kPoint, kHollowPoint };

struct LegendEntry {
  Mark mark;
  std::string_view color;
  std::string text;
};

// Gnuplot's style of a mark, the same in the legend and in the panels: line type or point type,
// width, colour.
std::string mark_style(Mark mark, std::string_view color);

double legend_width_px(const std::vector<LegendEntry>& entries);

// Labels and marks centred at (centre_x, y), in the axes of a plot that begins next.
void draw_legend(Script& script, const std::vector<LegendEntry>& entries, double centre_x_px,
                 double y_px);

}  // namespace skyfit::plot
