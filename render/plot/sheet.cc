// SPDX-License-Identifier: Apache-2.0
#include "render/plot/sheet.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "model/base/text.h"

namespace skyfit::plot {
namespace {

constexpr double kPointsPerMillimetre = 72 / 25.4;

struct Font {
  std::string_view name;
  double on_screen, on_page;  // gnuplot's points, of which kTextPixels are 9
};
constexpr std::array<Font, 7> kFonts = {{{"title_font", 18, 10.5},
                                         {"heading_font", 14, 9},
                                         {"axis_font", 13, 9},
                                         {"text_font", 12, 9},
                                         {"note_font", 11, 9},
                                         {"small_font", 10, 9},
                                         {"sun_font", 15, 11}}};

std::size_t characters(std::string_view text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](char c) { return (c & 0xc0) != 0x80; }));
}

std::size_t most_characters(double width_px, const Sheet& sheet) {
  return static_cast<std::size_t>(std::max(4.0, width_px / sheet.character_px()));
}

// The first `count` characters.
std::string_view first_characters(std::string_view text, std::size_t count) {
  std::size_t end = 0;
  while (end < text.size() && (count > 0 || (text[end] & 0xc0) == 0x80)) {
    if ((text[end] & 0xc0) != 0x80) --count;
    ++end;
  }
  return text.substr(0, end);
}

}  // namespace

double Sheet::pixels_per_mm() const { return kPointsPerMillimetre * kTextPixels / font_pt; }

double Sheet::width_px(double own_px) const {
  return on_page() ? width_mm * pixels_per_mm() : own_px;
}

std::vector<std::size_t> Sheet::chosen(const std::vector<std::string>& names) const {
  std::vector<std::size_t> places;
  for (const int panel : panels) {
    if (panel < 1 || static_cast<std::size_t>(panel) > names.size()) {
      std::vector<std::string> numbered;
      for (std::size_t i = 0; i < names.size(); ++i)
        numbered.push_back(fmt::format("{} ({})", i + 1, names[i]));
      throw std::invalid_argument(
          fmt::format("figure: panel {}: expected one of {}", panel, fmt::join(numbered, ", ")));
    }
    places.push_back(static_cast<std::size_t>(panel - 1));
  }
  if (panels.empty())
    for (std::size_t i = 0; i < names.size(); ++i) places.push_back(i);
  return places;
}

std::string font_names(const Sheet& sheet) {
  std::string text;
  for (const Font& font : kFonts)
    text +=
        fmt::format("{} = ',{:g}'\n", font.name, sheet.on_page() ? font.on_page : font.on_screen);
  return text;
}

std::vector<std::string> wrapped(std::string_view text, double width_px, const Sheet& sheet) {
  const std::size_t most = most_characters(width_px, sheet);
  std::vector<std::string> lines;
  std::vector<std::string> words;
  for (const std::string_view part : split(text, ' ')) {
    if (part.starts_with('%') && !words.empty())
      words.back() += " " + std::string(part);  // stays with its number
    else
      words.emplace_back(part);
  }
  for (const std::string& whole : words) {
    std::string word = shortened(whole, width_px, sheet);
    if (!lines.empty() && characters(lines.back()) + 1 + characters(word) <= most)
      lines.back() += " " + word;
    else
      lines.push_back(std::move(word));
  }
  return lines;
}

double text_width_px(std::string_view text, const Sheet& sheet) {
  return sheet.character_px() * static_cast<double>(characters(text));
}

std::string shortened(std::string_view text, double width_px, const Sheet& sheet) {
  const std::size_t most = most_characters(width_px, sheet);
  if (characters(text) <= most) return std::string(text);
  return std::string(first_characters(text, most - 3)) + "...";
}

}  // namespace skyfit::plot
