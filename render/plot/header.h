// SPDX-License-Identifier: Apache-2.0
// What stands above the panels of a figure: title, subtitle and legend, in as many lines as they
// need.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "render/plot/legend.h"

namespace skyfit::plot {

class Header {
 public:
  // For a figure that is `width_px` wide, of which the legend may have less; the sheet may do
  // without the title.
  Header(const Sheet& sheet, double width_px, const std::string& title, const std::string& subtitle,
         const std::vector<LegendEntry>& legend = {},
         double legend_width_px = std::numeric_limits<double>::infinity());

  double height_px() const { return height_; }

  // At the top of the canvas, in the axes of a plot that begins next. The legend is centred at
  // `legend_centre_px`; by default in the middle of the canvas.
  void draw(Script& script, double legend_centre_px) const;
  void draw(Script& script) const { draw(script, script.width() / 2); }

 private:
  double title_line_, height_;
  std::vector<std::string> title_, subtitle_;
  LegendRows legend_;
};

}  // namespace skyfit::plot
