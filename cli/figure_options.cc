// SPDX-License-Identifier: Apache-2.0
#include "cli/figure_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string_view>

#include "cli/arguments.h"
#include "model/base/text.h"

namespace skyfit::cli {
namespace {

constexpr double kLeastWidth_mm = 20, kMostWidth_mm = 2000, kLeastFont_pt = 4, kMostFont_pt = 72;

struct Style {
  std::string_view name, meaning;
  plot::Sheet sheet;
};

const std::array<Style, 2>& styles() {
  static const std::array<Style, 2> all = {
      {{"paper",
        "180 mm wide, text of 8 pt, no title: the caption says it",
        {.width_mm = 180, .font_pt = 8, .line_scale = 1, .has_title = false, .panels = {}}},
       {"slides",
        "254 mm wide, text of 14 pt, lines of 1.6 times the width",
        {.width_mm = 254, .font_pt = 14, .line_scale = 1.6, .has_title = true, .panels = {}}}}};
  return all;
}

const Style& style_named(const std::string& name) {
  const auto found = std::ranges::find(styles(), name, &Style::name);
  if (found != styles().end()) return *found;
  std::vector<std::string_view> names;
  for (const Style& style : styles()) names.push_back(style.name);
  throw UsageError("--style", name, fmt::format("expected one of {}", fmt::join(names, ", ")));
}

int panel_number(const std::string& text, std::string_view part) {
  int number = 0;
  const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), number);
  if (error != std::errc() || end != part.data() + part.size() || number < 1)
    throw UsageError("--panels", text, "expected numbers from 1 as in 1,3-5");
  return number;
}

// "1,3-5"
std::vector<int> parse_panels(const std::string& text) {
  constexpr int kMostPanels = 1000;
  std::vector<int> panels;
  for (const std::string_view part : split(text, ',')) {
    const std::size_t dash = part.find('-');
    const int first = panel_number(text, part.substr(0, dash));
    const int last = dash == part.npos ? first : panel_number(text, part.substr(dash + 1));
    if (last < first || last > kMostPanels)
      throw UsageError("--panels", text, "expected numbers from 1 as in 1,3-5");
    for (int panel = first; panel <= last; ++panel) {
      if (std::ranges::count(panels, panel) > 0)
        throw UsageError("--panels", text, "expected each panel once");
      panels.push_back(panel);
    }
  }
  return panels;
}

}  // namespace

void add_figure_options(CLI::App& command, FigureOptions& options) {
  command.add_option("--style", options.style, "Of the figure, for a page: paper or slides")
      ->type_name("NAME");
  command
      .add_option("--width-mm", options.width_mm,
                  "Width of the figure on a page, in which the panels are arranged anew;\n"
                  "by default that of the style")
      ->type_name("MM");
  command
      .add_option("--font-size", options.font_size,
                  "Size of the text on a page; by default that of the style")
      ->type_name("PT");
  command
      .add_option("--panels", options.panels,
                  "Panels that are drawn, by their number from the top left, in this order")
      ->type_name("1,3-5");
}

std::string style_lines() {
  return named_lines(styles()) +
         "A width or a size of text without a style has the title and the lines of the screen. A "
         "PNG of a\npage has 300 pixels per inch.\n";
}

plot::Sheet parse_sheet(const FigureOptions& options) {
  plot::Sheet sheet;
  const bool on_page =
      !options.style.empty() || !options.width_mm.empty() || !options.font_size.empty();
  if (on_page) {
    sheet = style_named(options.style.empty() ? "paper" : options.style).sheet;
    if (options.style.empty()) sheet.has_title = true;
  }
  if (!options.width_mm.empty())
    sheet.width_mm = parse_number_within("--width-mm", options.width_mm, kLeastWidth_mm,
                                         kMostWidth_mm, "a width in millimetres");
  if (!options.font_size.empty())
    sheet.font_pt = parse_number_within("--font-size", options.font_size, kLeastFont_pt,
                                        kMostFont_pt, "a size in points");
  const double least_mm = plot::kLeastWidthInText * sheet.font_pt * 25.4 / 72;
  if (on_page && sheet.width_mm < least_mm) {
    const bool width = !options.width_mm.empty();
    throw UsageError(width ? "--width-mm" : "--font-size",
                     width ? options.width_mm : options.font_size,
                     fmt::format("expected a width of at least {:.4g} times the size of the text, "
                                 "{:.4g} mm for {:g} pt",
                                 plot::kLeastWidthInText, least_mm, sheet.font_pt));
  }
  if (!options.panels.empty()) sheet.panels = parse_panels(options.panels);
  return sheet;
}

}  // namespace skyfit::cli
