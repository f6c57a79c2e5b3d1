// SPDX-License-Identifier: Apache-2.0
#include "render/plot/figure_style.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skyfit::plot {
namespace {

using Rgb = std::array<double, 3>;

constexpr std::array<Rgb, 9> kRedBlue = {{{33, 102, 172},
                                          {67, 147, 195},
                                          {146, 197, 222},
                                          {209, 229, 240},
                                          {247, 247, 247},
                                          {253, 219, 199},
                                          {244, 165, 130},
                                          {214, 96, 77},
                                          {178, 24, 43}}};

// The colours of kRedBlue, with one in the place of white; both ends are the same.
constexpr Rgb kBlack = {32, 32, 32};
constexpr std::array<Rgb, 9> kHalfTurn = {{kBlack,
                                           {17, 54, 96},
                                           kRedBlue[0],
                                           kRedBlue[2],
                                           kRedBlue[4],
                                           kRedBlue[6],
                                           kRedBlue[8],
                                           {96, 24, 36},
                                           kBlack}};

constexpr std::array<Rgb, 9> kViridis = {{{68, 1, 84},
                                          {71, 44, 122},
                                          {59, 81, 139},
                                          {44, 113, 142},
                                          {33, 144, 141},
                                          {39, 173, 129},
                                          {92, 200, 99},
                                          {170, 220, 50},
                                          {253, 231, 37}}};

// The color at a share 0..1 of the way along the list.
std::string blended(const std::array<Rgb, 9>& colors, double share) {
  const double position = share * static_cast<double>(colors.size() - 1);
  const auto lower = std::min(static_cast<std::size_t>(position), colors.size() - 2);
  const double blend = position - static_cast<double>(lower);
  std::string color = "#";
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const double level = std::lerp(colors[lower][channel], colors[lower + 1][channel], blend);
    color += fmt::format("{:02x}", static_cast<int>(std::lround(level)));
  }
  return color;
}

// Plain digits where they are short, a power of ten where they are not.
std::string tick_label(double mantissa, int exponent) {
  if (exponent >= -3 && exponent <= 3)
    return fmt::format("{:.9g}", mantissa * std::pow(10.0, exponent));
  return mantissa == 1 ? fmt::format("10^{{{}}}", exponent)
                       : fmt::format("{:g}·10^{{{}}}", mantissa, exponent);
}

}  // namespace

std::string diverging_color(double value, double limit) {
  return blended(kRedBlue, (std::clamp(value / limit, -1.0, 1.0) + 1) / 2);
}

std::string sequential_color(double share) {
  return blended(kViridis, std::clamp(share, 0.0, 1.0));
}

std::string half_turn_color(double angle_deg) {
  return blended(kHalfTurn, std::remainder(angle_deg, 180.0) / 180 + 0.5);
}

double round_up(double value) {
  const double decade = std::pow(10.0, std::floor(std::log10(value)));
  for (const double mantissa : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (mantissa * decade >= value * (1 - 1e-12)) return mantissa * decade;
  return 10 * decade;
}

std::vector<Tick> log_ticks(double lower, double upper) {
  const double decades = std::log10(upper / lower);
  std::vector<Tick> ticks;
  const int first = static_cast<int>(std::floor(std::log10(lower)));
  const int last = static_cast<int>(std::ceil(std::log10(upper)));
  for (int exponent = first; exponent <= last; ++exponent)
    for (int mantissa = 1; mantissa <= 9; ++mantissa) {
      const double position = mantissa * std::pow(10.0, exponent);
      if (position < lower || position > upper) continue;
      const double along = std::log10(position / lower) / decades;
      const bool named = mantissa == 1 || (decades < 3 && (mantissa == 2 || mantissa == 5));
      const bool clear = along > 0.04 && along < 0.96;
      ticks.push_back({position, named && clear ? tick_label(mantissa, exponent) : ""});
    }
  return ticks;
}

Box Grid::cell(std::size_t index) const {
  const double width = area.width / static_cast<double>(columns);
  const double height = area.height / static_cast<double>(rows);
  const auto column = static_cast<double>(index % columns);
  const auto row = static_cast<double>(index / columns);
  return {area.left + column * width, area.top() - (row + 1) * height, width, height};
}

std::size_t panel_columns(std::size_t count) {
  if (count == 4) return 2;
  return count <= 3 ? count : count <= 9 ? 3 : 4;
}

}  // namespace skyfit::plot
