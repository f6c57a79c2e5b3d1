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

std::size_t Script::text_lines(double x_px, double y_px, double width_px, std::string_view text,
                               std::string_view style) {
  const std::vector<std::string> lines = wrapped(text, width_px, sheet_);
  for (std::size_t i = 0; i < lines.size(); ++i)
    text_label(x_px, y_px - sheet_.line_px() * static_cast<double>(i), lines[i], style);
  return lines.size();
}

std::size_t Script::upright_lines(double x_px, double y_px, double length_px, std::string_view text,
                                  std::string_view style) {
  const std::vector<std::string> lines = wrapped(text, length_px, sheet_);
  for (std::size_t i = 0; i < lines.size(); ++i)
    text_label(x_px + sheet_.line_px() * static_cast<double>(i), y_px, lines[i],
               fmt::format("center rotate by 90 {}", style));
  return lines.size();
}

}  // namespace skyfit::plot
