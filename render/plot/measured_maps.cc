// SPDX-License-Identifier: Apache-2.0
// Measured, model and their ratio over the sky, side by side; a row per scan.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "model/base/misfit.h"
#include "model/base/text.h"
#include "render/plot/color_scale.h"
#include "render/plot/header.h"
#include "render/plot/hemisphere_maps.h"
#include "render/plot/measured_figures.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kCell = 330, kTitle = 30, kLabel = 176;
constexpr std::size_t kMaxRows = 6;

// A scan's name in lines that the column of names holds, broken at spaces; of a longer word the
// end stays.
std::vector<std::string> label_lines(const std::string& name) {
  constexpr std::size_t kCharacters = 22;
  std::vector<std::string> lines;
  for (const std::string_view part : split(name, ' ')) {
    std::string word(part);
    if (word.size() > kCharacters) {
      std::size_t begin = word.size() - kCharacters + 3;
      while (begin < word.size() && (word[begin] & 0xC0) == 0x80) ++begin;  // inside a character
      word = "..." + word.substr(begin);
    }
    if (!lines.empty() && lines.back().size() + 1 + word.size() <= kCharacters) {
      lines.back() += " " + word;
    } else {
      lines.push_back(word);
    }
  }
  return lines;
}

// How far the model is off, and what its colours span on either side of 0: percents of the measured
// value, or where these are large 100 times the logarithm of the ratio.
struct Misfit {
  bool is_logarithm = false;
  double limit = 1;
  double of(const Sample& s) const {
    const double ratio = s.model / s.reference;
    return 100 * (is_logarithm ? std::log(ratio) : ratio - 1);
  }
  std::string text(double value) const {
    return is_logarithm ? fmt::format("×{:.2g}", std::exp(value / 100))
                        : fmt::format("{:.3g}", value);
  }
};

std::array<std::string_view, 3> titles_of(const Misfit& misfit, const Sheet& sheet) {
  if (misfit.is_logarithm)
    return {"measured", "model", sheet.on_page() ? "ratio" : "model / measured"};
  return {"measured", "model", sheet.on_page() ? "ratio − 1" : "model / measured − 1"};
}

struct Row {
  int scan;
  std::vector<Sample> sky;
};

std::vector<Row> rows_of(const MeasuredOutcome& outcome, const Sheet& sheet) {
  std::vector<Row> rows;
  for (const MeasuredDirection& d : directions_of(outcome)) {
    if (rows.empty() || rows.back().scan != d.scan) rows.push_back({d.scan, {}});
    rows.back().sky.push_back({d.scan, d.sun_zenith_deg, d.view_zenith_deg, d.relative_azimuth_deg,
                               0, d.measured, 0, d.model, d.counted ? 1.0 : 0.0});
  }
  std::vector<std::string> names;
  for (const Row& row : rows) names.push_back(scan_label(outcome, row.scan));
  std::vector<Row> chosen;
  for (const std::size_t place : sheet.chosen(names)) chosen.push_back(rows[place]);
  if (chosen.size() > kMaxRows) chosen.resize(kMaxRows);
  return chosen;
}

// What the colours of luminance span, over all maps.
struct Range {
  double lower = std::numeric_limits<double>::infinity(), upper = 0;
  double share(double value) const { return std::log(value / lower) / std::log(upper / lower); }
};

Range range_of(const std::vector<Row>& rows) {
  Range range;
  for (const Row& row : rows) {
    for (const Sample& s : row.sky) {
      if (!(s.weight > 0 && s.reference > 0)) continue;
      range.lower = std::min(range.lower, s.reference);
      range.upper = std::max(range.upper, s.reference);
    }
  }
  return range;
}

// 95 % of the samples lie within.
double limit_of(const std::vector<Row>& rows, const Misfit& misfit) {
  std::vector<double> sizes;
  for (const Row& row : rows) {
    for (const Sample& s : row.sky)
      if (s.weight > 0 && s.reference > 0 && s.model > 0) sizes.push_back(std::abs(misfit.of(s)));
  }
  if (sizes.empty()) return 1;
  const auto rank = static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, sizes.begin() + rank);
  return round_up(std::max(sizes[static_cast<std::size_t>(rank)], 0.01));
}

Misfit misfit_of(const std::vector<Row>& rows) {
  Misfit misfit;
  misfit.limit = limit_of(rows, misfit);
  if (!is_factor(misfit.limit)) return misfit;
  misfit.is_logarithm = true;
  misfit.limit = limit_of(rows, misfit);
  return misfit;
}

template <class ColorOf>
void draw_map(Script& script, const Box& box, const Row& row, const ColorOf& color_of) {
  script.begin_axes(box);
  script.line("set xrange [-1.01:1.01]; set yrange [-1.01:1.01]");
  const std::vector<Patch> patches = patches_of(row.sky);
  for (const Patch& patch : patches) {
    script.line(
        "set object polygon from {} behind fs solid border lc rgb '#ffffff' lw 0.4 fc rgb '{}'",
        patch_outline(patch), color_of(*patch.sample));
  }
  for (const Sample& s : row.sky) {
    if (!patches.empty()) break;
    script.line("set object circle at {} size 0.05 behind fs solid noborder fc rgb '{}'",
                polar_point(s.view_zenith_deg, s.relative_azimuth_deg), color_of(s));
  }
  for (const double zenith : {30.0, 60.0})
    script.line(
        "set object circle at 0,0 size {:.9g} front fs empty border lc rgb '#606060' lw 0.5",
        zenith / 90);
  script.line("set object circle at 0,0 size 1 front fs empty border lc rgb '{}' lw 1",
              kFrameColor);
  script.line("set label '☉' at {} center front font sun_font textcolor rgb '#000000'",
              polar_point(row.sky.front().sun_zenith_deg, 0));
  script.line("plot NaN notitle");
}

// Names stand to the left of a row, on a page above it.
struct Layout {
  double width, left, cell, margin, above;
  double row_px() const { return cell + above; }
};

Layout layout_of(const Sheet& sheet) {
  constexpr double kGap = 4;
  const double width = sheet.width_px(kLabel + 3 * kCell + 10);
  if (!sheet.on_page()) return {width, kLabel, kCell, kTitle, 0};
  return {width, kGap, std::min((width - 2 * kGap) / 3, kCell), 10, sheet.line_px()};
}

// The two colour scales side by side, or one above the other where their titles would not find a
// place.
struct Scales {
  Box luminance, ratio;
  double height;
};

Scales scales_of(const Sheet& sheet, const Layout& layout) {
  if (!sheet.on_page())
    return {{kLabel + 0.35 * kCell, 52, 1.3 * kCell, 14},
            {kLabel + 2.1 * kCell, 52, 0.8 * kCell, 14},
            84};
  constexpr double kBar = 10, kBesides = 600;
  const double below = 20 + 2 * sheet.line_px();  // numbers and two lines of title
  if (layout.width >= kBesides)
    return {{layout.left + 0.2 * layout.cell, below, 1.5 * layout.cell, kBar},
            {layout.left + 2.05 * layout.cell, below, 0.9 * layout.cell, kBar},
            below + kBar + 8};
  const double row = below + kBar + 8;
  return {{0.12 * layout.width, row + below, 0.76 * layout.width, kBar},
          {0.12 * layout.width, below, 0.76 * layout.width, kBar},
          2 * row};
}

void draw_scales(Script& script, const Scales& scales, const Range& range, const Misfit& misfit) {
  std::vector<Tick> luminance = log_ticks(range.lower / 1000, range.upper / 1000);
  for (Tick& tick : luminance) tick.position = range.share(tick.position * 1000);
  draw_color_scale(script, scales.luminance, luminance, "luminance, kcd m⁻² (logarithmic)",
                   [](double at) { return sequential_color(at); });
  std::vector<Tick> ratio;
  for (const double at : {0.0, 0.25, 0.5, 0.75, 1.0})
    ratio.push_back({at, misfit.text(misfit.limit * (2 * at - 1))});
  draw_color_scale(script, scales.ratio, ratio,
                   misfit.is_logarithm ? "model / measured; grey: not fitted"
                                       : "model / measured − 1, %; grey: not fitted",
                   [](double at) { return diverging_color(2 * at - 1, 1); });
}

void draw_names(Script& script, const Layout& layout, const MeasuredOutcome& outcome,
                const Row& row, double top) {
  const MeasuredScan& info = outcome.scans.at(static_cast<std::size_t>(row.scan - 1));
  const std::string sun = fmt::format("☉ {:.3g}°", row.sky.front().sun_zenith_deg),
                    error = std::isfinite(info.luminance_error_percent)
                                ? fmt::format("RMS {:.3g} %", info.luminance_error_percent)
                                : "",
                    label = scan_label(outcome, row.scan);
  if (script.sheet().on_page()) {
    const std::string numbers = fmt::format("   {}   {}", sun, error);
    const double room = layout.width - 2 * layout.left - text_width_px(numbers, script.sheet());
    script.text_label(layout.left, top + layout.above / 2,
                      shortened(label, room, script.sheet()) + numbers, "left font text_font");
    return;
  }
  const double side = layout.cell - layout.margin;
  const std::vector<std::string> name = label_lines(label);
  for (std::size_t i = 0; i < name.size(); ++i) {
    const auto lines_below = static_cast<double>(name.size() - 1 - i);
    script.text_label(kLabel - 4, top - side / 2 + 12 + 20 * lines_below, name[i],
                      "right font note_font");
  }
  script.text_label(kLabel - 4, top - side / 2 - 8, sun, "right font note_font");
  script.text_label(kLabel - 4, top - side / 2 - 28, error, "right font note_font");
}

void draw_row(Script& script, const Layout& layout, const MeasuredOutcome& outcome, const Row& row,
              double top, const Range& range, const Misfit& misfit) {
  const double side = layout.cell - layout.margin;
  const auto box = [&](int column) {
    return Box{layout.left + column * layout.cell + layout.margin / 2, top - side, side, side};
  };
  const auto shown = [](const Sample& s) { return s.weight > 0; };
  draw_map(script, box(0), row, [&](const Sample& s) {
    return shown(s) ? sequential_color(range.share(s.reference)) : std::string(kLeftOutColor);
  });
  draw_map(script, box(1), row, [&](const Sample& s) {
    return sequential_color(range.share(std::max(s.model, range.lower)));
  });
  draw_map(script, box(2), row, [&](const Sample& s) {
    return shown(s) ? diverging_color(misfit.of(s), misfit.limit) : std::string(kLeftOutColor);
  });
  script.begin_axes(box(0));
  draw_names(script, layout, outcome, row, top);
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
}

}  // namespace

Figure maps_figure(const MeasuredOutcome& outcome, const Sheet& sheet) {
  const std::vector<Row> rows = rows_of(outcome, sheet);
  const Range range = range_of(rows);
  const Misfit misfit = misfit_of(rows);
  const Layout layout = layout_of(sheet);
  std::string subtitle = "centre zenith, rim horizon, sun's side right";
  if (outcome.scans.size() > rows.size())
    subtitle += fmt::format("; {} of {} scans", rows.size(), outcome.scans.size());
  const Header header(sheet, layout.width, short_name(outcome.title), subtitle);
  std::size_t title_lines = 1;
  const auto names = titles_of(misfit, sheet);
  for (const std::string_view title : names)
    title_lines = std::max(title_lines, wrapped(title, layout.cell, sheet).size());
  const Scales scales = scales_of(sheet, layout);
  const double titles = sheet.line_px() * static_cast<double>(title_lines) + 4;
  const double height = header.height_px() + titles +
                        layout.row_px() * static_cast<double>(rows.size()) + scales.height;
  Script script(layout.width, height, sheet);
  script.line("set multiplot");
  script.begin_axes({0, 0, script.width(), height});
  header.draw(script);
  const double top = height - header.height_px();
  for (int column = 0; column < 3; ++column)
    script.text_lines(layout.left + (column + 0.5) * layout.cell, top - sheet.line_px() / 2,
                      layout.cell, names[static_cast<std::size_t>(column)],
                      "center font heading_font");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  for (std::size_t r = 0; r < rows.size(); ++r)
    draw_row(script, layout, outcome, rows[r],
             top - titles - layout.above - layout.row_px() * static_cast<double>(r), range, misfit);
  draw_scales(script, scales, range, misfit);
  script.line("unset multiplot");
  return figure_of(script);
}

}  // namespace skyfit::plot
