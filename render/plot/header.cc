// SPDX-License-Identifier: Apache-2.0
#include "render/plot/header.h"

#include <algorithm>
#include <utility>

namespace skyfit::plot {
namespace {

constexpr double kBelow = 10;

// Of the widths of their characters, as of their sizes (font_names()).
double title_to_text(const Sheet& sheet) { return sheet.on_page() ? 1.25 : 1.55; }

double margin(const Sheet& sheet) { return sheet.on_page() ? 4 : 16; }

double rows_px(std::size_t count, double row_px) { return static_cast<double>(count) * row_px; }

}  // namespace

Header::Header(const Sheet& sheet, double width_px, const std::string& title,
               const std::string& subtitle, const std::vector<LegendEntry>& legend,
               double legend_width_px)
    : title_line_(sheet.on_page() ? 18 : 26) {
  const double width = width_px - 2 * margin(sheet);
  if (sheet.has_title) title_ = wrapped(title, width / title_to_text(sheet), sheet);
  if (!subtitle.empty()) subtitle_ = wrapped(subtitle, width, sheet);
  legend_ = legend_rows(legend, std::min(width, legend_width_px), sheet);
  height_ = margin(sheet) + rows_px(title_.size(), title_line_) +
            rows_px(subtitle_.size() + legend_.size(), sheet.line_px()) + kBelow;
}

void Header::draw(Script& script, double legend_centre_px) const {
  const Sheet& sheet = script.sheet();
  const double left = margin(sheet), line = sheet.line_px();
  double y = script.height() - margin(sheet) / 2;
  for (const std::string& text : title_) {
    script.text_label(left, y - title_line_ / 2, text, "left font title_font");
    y -= title_line_;
  }
  for (const std::string& text : subtitle_) {
    script.text_label(left, y - line / 2, text, "left font text_font textcolor rgb '#404040'");
    y -= line;
  }
  draw_legend(script, legend_, legend_centre_px, y - line / 2 - margin(sheet) / 4);
}

}  // namespace skyfit::plot
