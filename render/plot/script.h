// SPDX-License-Identifier: Apache-2.0
// Text of a gnuplot script that draws one figure inside `set multiplot`.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>

#include "render/plot/figure_style.h"

namespace skyfit::plot {

class Script {
 public:
  Script(double width_px, double height_px) : width_(width_px), height_(height_px) {}

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

  // A label on the canvas; `style` is gnuplot's, e.g. "right font ',11'". The text is taken
  // literally.
  void text_label(double x_px, double y_px, std::string_view text, std::string_view style);

 private:
  double width_, height_;
  std::string text_;
};

}  // namespace skyfit::plot
