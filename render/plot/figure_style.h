// SPDX-License-Identifier: Apache-2.0
// Geometry, colours and tick marks of the figures. Lengths in pixels of a canvas whose origin is at
// the bottom left.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit::plot {

struct Box {
  double left = 0, bottom = 0, width = 0, height = 0;
  double right() const { return left + width; }
  double top() const { return bottom + height; }
};

// Okabe & Ito 2008, told apart with every common colour vision; the last five are darker.
inline constexpr std::array<std::string_view, 11> kCurveColors = {
    "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00",
    "#6a3d9a", "#8c510a", "#7f7f00", "#00304d", "#882255"};
inline constexpr std::string_view kReferenceColor = "#202020";
inline constexpr std::string_view kStartColor = "#d55e00";
inline constexpr std::string_view kSunColor = "#b87a00";
inline constexpr std::string_view kSunShade = "#f6e3b4";
inline constexpr std::string_view kGridColor = "#e2e2e2";
inline constexpr std::string_view kFrameColor = "#707070";
inline constexpr std::string_view kLeftOutColor = "#808080";

// Diverging colour "#rrggbb" of value in -limit..limit (clamped): blue below, near white at 0, red
// above (ColorBrewer RdBu, safe for common colour vision deficiencies).
std::string diverging_color(double value, double limit);

// Sequential color "#rrggbb" of a share 0..1 (clamped), dark to bright (viridis of Smith & van der
// Walt 2015, read at nine places).
std::string sequential_color(double share);

// Colour of a direction that is the same after half a turn: near white at 0 deg, red at 45, nearly
// black at 90, blue at 135 (-45).
std::string half_turn_color(double angle_deg);

// The next of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten, >= value > 0.
double round_up(double value);

struct Tick {
  double position;
  std::string label;  // empty: a minor tick
};

// Ticks of a logarithmic axis: decades, with 2 and 5 between them when there are fewer than three
// decades. Labels closer than 4 % of the axis to its ends are dropped, because those of
// neighbouring panels would collide.
std::vector<Tick> log_ticks(double lower, double upper);

// `count` boxes in a grid that fills `area` row by row from the top left.
struct Grid {
  std::size_t columns, rows;
  Box area;
  Box cell(std::size_t index) const;
};

// Columns of the panels' grid: 1, 2, 3, 2x2, then rows of three, then of four.
std::size_t panel_columns(std::size_t count);

}  // namespace skyfit::plot
