// SPDX-License-Identifier: Apache-2.0
// What a figure is drawn on. On a screen every figure has a width of its own. On a page the width
// and the size of the text are given in millimetres and points, and the figure arranges its panels
// so that text of that size has room.
//
// Lengths of a layout are pixels. On a page kTextPixels of them are the size of the text, so that a
// page of 85 mm with text of 8 pt is 361 pixels wide, whatever it is printed with.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit::plot {

inline constexpr double kTextPixels = 12;

struct Sheet {
  double width_mm = 0;      // 0: on a screen
  double font_pt = 8;       // of all text but the title, on a page
  double line_scale = 1;    // widths of lines
  bool has_title = true;    // in a paper the caption says it
  std::vector<int> panels;  // from 1, those that are drawn, in this order; empty: all

  bool on_page() const { return width_mm > 0; }
  double pixels_per_mm() const;
  // The page's in pixels; on a screen the figure's own.
  double width_px(double own_px) const;
  // The mean width of a character of DejaVu Sans, with some air.
  double character_px() const { return on_page() ? 6.6 : 8.2; }
  double line_px() const { return on_page() ? 16 : 22; }

  // The places, from 0, of the panels that are drawn, of those that the figure has. Throws
  // std::invalid_argument that lists the panels with their numbers when one is named that the
  // figure has not.
  std::vector<std::size_t> chosen(const std::vector<std::string>& names) const;
};

// A page is at least 20 times as wide as its text is high: about 36 characters.
inline constexpr double kLeastWidthInText = 20;

// gnuplot's commands that name the fonts of the labels: title_font, heading_font, axis_font,
// text_font, note_font, small_font and sun_font.
std::string font_names(const Sheet& sheet);

// Lines of at most `width_px`, broken at spaces; a longer word ends in "...".
std::vector<std::string> wrapped(std::string_view text, double width_px, const Sheet& sheet);
double text_width_px(std::string_view text, const Sheet& sheet);
// The text, or its beginning and "..." where it is wider.
std::string shortened(std::string_view text, double width_px, const Sheet& sheet);

}  // namespace skyfit::plot
