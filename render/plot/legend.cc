// SPDX-License-Identifier: Apache-2.0
#include "render/plot/legend.h"

#include <algorithm>

namespace skyfit::plot {
namespace {

constexpr double kMarkWidth = 30, kMarkGap = 6, kEntryGap = 24;

double width_of(const LegendEntry& entry, const Sheet& sheet) {
  return kMarkWidth + kMarkGap + text_width_px(entry.text, sheet);
}

bool is_line(Mark mark) { return mark == Mark::kSolidLine || mark == Mark::kDashedLine; }

}  // namespace

std::string mark_style(Mark mark, std::string_view color) {
  switch (mark) {
    case Mark::kSolidLine:
      return fmt::format("lw 2.4 pt 7 ps 0.3 lc rgb '{}'", color);
    case Mark::kDashedLine:
      return fmt::format("lw 1.8 dt (8,5) lc rgb '{}'", color);
    case Mark::kPoint:
      return fmt::format("pt 7 ps 0.45 lc rgb '{}'", color);
    case Mark::kHollowPoint:
      return fmt::format("pt 6 ps 0.5 lc rgb '{}'", color);
  }
  return {};
}

double legend_width_px(const std::vector<LegendEntry>& entries, const Sheet& sheet) {
  double width = -kEntryGap;
  for (const auto& entry : entries) width += width_of(entry, sheet) + kEntryGap;
  return width;
}

LegendRows legend_rows(const std::vector<LegendEntry>& entries, double width_px,
                       const Sheet& sheet) {
  LegendRows rows;
  for (LegendEntry entry : entries) {
    const double most = width_px - kMarkWidth - kMarkGap;
    if (text_width_px(entry.text, sheet) > most) entry.text = shortened(entry.text, most, sheet);
    if (rows.empty() ||
        legend_width_px(rows.back(), sheet) + kEntryGap + width_of(entry, sheet) > width_px)
      rows.emplace_back();
    rows.back().push_back(std::move(entry));
  }
  return rows;
}

void draw_legend(Script& script, const LegendRows& rows, double centre_x_px, double y_px) {
  for (const std::vector<LegendEntry>& row : rows) {
    double x = centre_x_px - legend_width_px(row, script.sheet()) / 2;
    for (const LegendEntry& entry : row) {
      const std::string style = mark_style(entry.mark, entry.color);
      if (is_line(entry.mark))
        script.line("set arrow from {} to {} nohead {}", script.at(x, y_px),
                    script.at(x + kMarkWidth, y_px), style);
      else
        script.line("set label '' at {} point {}", script.at(x + kMarkWidth - 6, y_px), style);
      script.text_label(x + kMarkWidth + kMarkGap, y_px, entry.text, "left font text_font");
      x += width_of(entry, script.sheet()) + kEntryGap;
    }
    y_px -= script.sheet().line_px();
  }
}

}  // namespace skyfit::plot
