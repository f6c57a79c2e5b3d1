// SPDX-License-Identifier: Apache-2.0
// Text of a gnuplot script that draws one figure inside `set multiplot`. The fonts of labels have
// names, see font_names().
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "render/plot/figure_style.h"
#include "render/plot/sheet.h"

namespace skyfit::plot {

class Script {
 public:
  Script(double width_px, double height_px, Sheet sheet)
      : width_(width_px), height_(height_px), sheet_(std::move(sheet)) {}

  const Sheet& sheet() const { return sheet_; }
  double width() const { return width_; }
  double height() const { return height_; }
  const std::string& text() const { return text_; }

  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_ += '\n';
  }

  // The axes of the next plot fill the box; ticks, labels, objects, arrows and key start from
  // nothing.
  void begin_axes(const Box& box);

  // "screen x, screen y" of a point of the canvas.
  std::string at(double x_px, double y_px) const;

  // A label on the canvas; `style` is gnuplot's, e.g. "right font text_font". The text is taken
  // literally.
  void text_label(double x_px, double y_px, std::string_view text, std::string_view style);

  // Lines of at most `width_px`, the first at `y_px`; returns how many.
  std::size_t text_lines(double x_px, double y_px, double width_px, std::string_view text,
                         std::string_view style);

  // As text_lines(), but from bottom to top, the first line at `x_px`, centred at `y_px`.
  std::size_t upright_lines(double x_px, double y_px, double length_px, std::string_view text,
                            std::string_view style);

 private:
  double width_, height_;
  Sheet sheet_;
  std::string text_;
};

}  // namespace skyfit::plot
