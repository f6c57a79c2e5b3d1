// SPDX-License-Identifier: Apache-2.0
#include "render/plot/legend.h"

#include <algorithm>

namespace skyfit::plot {
namespace {

constexpr double kMarkWidth = 30, kMarkGap = 6, kEntryGap = 24;
constexpr double kCharacterWidth = 8.2;  // mean of DejaVu Sans at this size, with some air

double width_of(const LegendEntry& entry) {
  const auto characters =
      std::ranges::count_if(entry.text, [](char c) { return (c & 0xc0) != 0x80; });
  return kMarkWidth + kMarkGap + kCharacterWidth * static_cast<double>(characters);
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

double legend_width_px(const std::vector<LegendEntry>& entries) {
  double width = -kEntryGap;
  for (const auto& entry : entries) width += width_of(entry) + kEntryGap;
  return width;
}

void draw_legend(Script& script, const std::vector<LegendEntry>& entries, double centre_x_px,
                 double y_px) {
  double x = centre_x_px - legend_width_px(entries) / 2;
  for (const auto& entry : entries) {
    const std::string style = mark_style(entry.mark, entry.color);
    if (is_line(entry.mark))
      script.line("set arrow from {} to {} nohead {}", script.at(x, y_px),
                  script.at(x + kMarkWidth, y_px), style);
    else
      script.line("set label '' at {} point {}", script.at(x + kMarkWidth - 6, y_px), style);
    script.text_label(x + kMarkWidth + kMarkGap, y_px, entry.text, "left font ',12'");
    x += width_of(entry) + kEntryGap;
  }
}

}  // namespace skyfit::plot
