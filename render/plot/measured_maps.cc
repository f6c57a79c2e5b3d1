// SPDX-License-Identifier: Apache-2.0
// Measured, model and their ratio over the sky, side by side; a row per scan.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "model/base/text.h"
#include "render/plot/color_scale.h"
#include "render/plot/hemisphere_maps.h"
#include "render/plot/measured_figures.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kCell = 330, kHeader = 92, kFooter = 84, kTitle = 30, kLabel = 176;
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

double ratio_percent(const Sample& s) { return 100 * (s.model / s.reference - 1); }

struct Row {
  int scan;
  std::vector<Sample> sky;
};

std::vector<Row> rows_of(const MeasuredOutcome& outcome) {
  std::vector<Row> rows;
  for (const MeasuredDirection& d : directions_of(outcome)) {
    if (rows.empty() || rows.back().scan != d.scan) rows.push_back({d.scan, {}});
    rows.back().sky.push_back({d.scan, d.sun_zenith_deg, d.view_zenith_deg, d.relative_azimuth_deg,
                               0, d.measured, 0, d.model, d.counted ? 1.0 : 0.0});
  }
  if (rows.size() > kMaxRows) rows.resize(kMaxRows);
  return rows;
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

double ratio_limit_percent(const std::vector<Row>& rows) {
  std::vector<double> sizes;
  for (const Row& row : rows) {
    for (const Sample& s : row.sky)
      if (s.weight > 0) sizes.push_back(std::abs(ratio_percent(s)));
  }
  if (sizes.empty()) return 1;
  const auto rank = static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, sizes.begin() + rank);
  return round_up(std::max(sizes[static_cast<std::size_t>(rank)], 0.01));
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
  script.line("set label '☉' at {} center front font ',16' textcolor rgb '#000000'",
              polar_point(row.sky.front().sun_zenith_deg, 0));
  script.line("plot NaN notitle");
}

void draw_scales(Script& script, const Range& range, double limit) {
  std::vector<Tick> luminance = log_ticks(range.lower / 1000, range.upper / 1000);
  for (Tick& tick : luminance) tick.position = range.share(tick.position * 1000);
  draw_color_scale(script, {kLabel + 0.35 * kCell, 52, 1.3 * kCell, 14}, luminance,
                   "luminance, kcd m⁻² (logarithmic)",
                   [](double at) { return sequential_color(at); });
  std::vector<Tick> ratio;
  for (const double at : {0.0, 0.25, 0.5, 0.75, 1.0})
    ratio.push_back({at, fmt::format("{:.3g}", limit * (2 * at - 1))});
  draw_color_scale(script, {kLabel + 2.1 * kCell, 52, 0.8 * kCell, 14}, ratio,
                   "model / measured − 1, %; grey: not fitted",
                   [](double at) { return diverging_color(2 * at - 1, 1); });
}

void draw_row(Script& script, const MeasuredOutcome& outcome, const Row& row, double top,
              const Range& range, double limit) {
  const MeasuredScan& info = outcome.scans.at(static_cast<std::size_t>(row.scan - 1));
  const double side = kCell - kTitle;
  const auto box = [&](int column) {
    return Box{kLabel + column * kCell + kTitle / 2, top - side, side, side};
  };
  const auto shown = [](const Sample& s) { return s.weight > 0; };
  draw_map(script, box(0), row, [&](const Sample& s) {
    return shown(s) ? sequential_color(range.share(s.reference)) : std::string(kLeftOutColor);
  });
  draw_map(script, box(1), row, [&](const Sample& s) {
    return sequential_color(range.share(std::max(s.model, range.lower)));
  });
  draw_map(script, box(2), row, [&](const Sample& s) {
    return shown(s) ? diverging_color(ratio_percent(s), limit) : std::string(kLeftOutColor);
  });
  script.begin_axes(box(0));
  const std::vector<std::string> name = label_lines(scan_label(outcome, row.scan));
  for (std::size_t i = 0; i < name.size(); ++i) {
    const double lines_below = static_cast<double>(name.size() - 1 - i);
    script.text_label(kLabel - 4, top - side / 2 + 12 + 20 * lines_below, name[i],
                      "right font ',11'");
  }
  script.text_label(kLabel - 4, top - side / 2 - 8,
                    fmt::format("☉ {:.3g}°", row.sky.front().sun_zenith_deg), "right font ',11'");
  script.text_label(kLabel - 4, top - side / 2 - 28,
                    fmt::format("RMS {:.3g} %", info.luminance_error_percent), "right font ',11'");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
}

}  // namespace

Figure maps_figure(const MeasuredOutcome& outcome) {
  const std::vector<Row> rows = rows_of(outcome);
  const Range range = range_of(rows);
  const double limit = ratio_limit_percent(rows);
  const double height = kHeader + kCell * static_cast<double>(rows.size()) + kFooter;
  Script script(kLabel + 3 * kCell + 10, height);
  script.line("set multiplot");
  script.begin_axes({0, 0, script.width(), height});
  script.text_label(16, height - 24, short_name(outcome.title), "left font ',18'");
  std::string subtitle = "centre zenith, rim horizon, sun's side right";
  if (outcome.scans.size() > rows.size())
    subtitle += fmt::format("; the first {} of {} scans", rows.size(), outcome.scans.size());
  script.text_label(16, height - 48, subtitle, "left font ',12' textcolor rgb '#404040'");
  constexpr std::string_view kTitles[] = {"measured", "model", "model / measured − 1"};
  for (int column = 0; column < 3; ++column)
    script.text_label(kLabel + (column + 0.5) * kCell, height - kHeader + 14, kTitles[column],
                      "center font ',14'");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  for (std::size_t r = 0; r < rows.size(); ++r)
    draw_row(script, outcome, rows[r], height - kHeader - kCell * static_cast<double>(r), range,
             limit);
  draw_scales(script, range, limit);
  script.line("unset multiplot");
  return {script.width(), height, script.text()};
}

}  // namespace skyfit::plot
