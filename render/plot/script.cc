// SPDX-License-Identifier: Apache-2.0
#include "render/plot/script.h"

#include "render/plot/gnuplot.h"

namespace skyfit::plot {

void Script::begin_axes(const Box& box) {
  line(
      "unset label; unset object; unset arrow; unset key; unset logscale; unset grid; unset title");
  line("unset xtics; unset ytics; unset xlabel; unset ylabel; unset border");
  line("set lmargin at screen {:.9g}; set rmargin at screen {:.9g}", box.left / width_,
       box.right() / width_);
  line("set bmargin at screen {:.9g}; set tmargin at screen {:.9g}", box.bottom / height_,
       box.top() / height_);
}

std::string Script::at(double x_px, double y_px) const {
  return fmt::format("screen {:.9g}, screen {:.9g}", x_px / width_, y_px / height_);
}

void Script::text_label(double x_px, double y_px, std::string_view text, std::string_view style) {
  line("set label {} at {} noenhanced {}", gnuplot_quoted(text), at(x_px, y_px), style);
}

}  // namespace skyfit::plot
