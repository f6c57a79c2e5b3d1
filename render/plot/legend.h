// SPDX-License-Identifier: Apache-2.0
// The figure's one legend.
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

double legend_width_px(const std::vector<LegendEntry>& entries, const Sheet& sheet);

// The entries in rows that are at most `width_px` wide; a longer text is cut, which "..." says.
using LegendRows = std::vector<std::vector<LegendEntry>>;
LegendRows legend_rows(const std::vector<LegendEntry>& entries, double width_px,
                       const Sheet& sheet);

// Labels and marks centred at centre_x, the first row at y, in the axes of a plot that begins next.
void draw_legend(Script& script, const LegendRows& rows, double centre_x_px, double y_px);

}  // namespace skyfit::plot
