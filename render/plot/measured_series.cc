// SPDX-License-Identifier: Apache-2.0
// Unknowns over the time of their scans: those of one scan each, of one fit or of several.
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "render/plot/header.h"
#include "render/plot/measured_figures.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kNarrow = 420;  // of a panel: times and dates would touch each other
constexpr double kWidth = 1080, kRow = 170, kRight = 48, kGap = 46;

struct Point {
  std::string time_utc;
  double value, sigma;
};

struct Series {
  std::string unit;
  std::vector<Point> points;
};

// "mie.scattering[2]" is a value of "mie.scattering".
std::string name_without_scan(const std::string& name) { return name.substr(0, name.find('[')); }

// The unknowns of two scans and more. Where the only scan of a fit has the unknown, its own and a
// shared one are the same.
std::map<std::string, Series> series_of(std::span<const MeasuredOutcome> fits) {
  std::map<std::string, Series> result;
  for (const MeasuredOutcome& fit : fits) {
    for (const MeasuredUnknown& unknown : fit.unknowns) {
      const int scan = unknown.scan > 0 ? unknown.scan : fit.scans.size() == 1 ? 1 : 0;
      if (scan == 0) continue;
      const MeasuredScan& info = fit.scans.at(static_cast<std::size_t>(scan - 1));
      if (info.time_utc.empty())
        throw std::invalid_argument(fmt::format(
            "figure series: {}: its time is not known, expected scans with a time", info.name));
      Series& series = result[name_without_scan(unknown.name)];
      series.unit = unknown.unit;
      series.points.push_back({info.time_utc, unknown.fitted, unknown.sigma});
    }
  }
  std::erase_if(result, [](const auto& entry) { return entry.second.points.size() < 2; });
  for (auto& [name, series] : result) std::ranges::sort(series.points, {}, &Point::time_utc);
  return result;
}

void draw_panel(Script& script, const Box& box, const std::string& name, const Series& series,
                std::size_t index, const char* time_format, bool last) {
  script.line("$series{} << EOD", index);
  for (const Point& point : series.points)
    script.line("{} {:.9g} {:.9g}", point.time_utc, point.value,
                std::isfinite(point.sigma) ? point.sigma : 0);
  script.line("EOD");
  script.begin_axes(box);
  script.text_label(box.left, box.top() + 12,
                    shortened(series.unit == "1" ? name : fmt::format("{}, {}", name, series.unit),
                              box.width, script.sheet()),
                    "left font text_font");
  script.line(
      "set border 3 lc rgb '{}'; set grid lc rgb '{}' lt 1; set xdata time; set timefmt "
      "'%Y-%m-%dT%H:%M:%SZ'",
      kFrameColor, kGridColor);
  script.line(
      "set xtics format '{}' {} nomirror textcolor rgb '#202020'; set ytics nomirror "
      "textcolor rgb '#202020'",
      last ? time_format : "", box.width < kNarrow ? "rotate by 35 right" : "norotate");
  script.line(
      "set format y '%g'; set autoscale; set offsets graph 0.03, graph 0.03, graph 0.1, graph 0.1");
  constexpr std::size_t kMostJoined = 100;
  if (series.points.size() <= kMostJoined) {
    script.line(
        "plot $series{0} using 1:2 with lines lw 1.4 lc rgb '{1}' notitle, $series{0} using "
        "1:2:3 with yerrorbars pt 7 ps 0.7 lw 1.6 lc rgb '{1}' notitle",
        index, kCurveColors[0]);
  } else {
    script.line("plot $series{} using 1:2:3 with yerrorbars pt 7 ps 0.3 lw 0.6 lc rgb '{}' notitle",
                index, kCurveColors[0]);
  }
  script.line("set xdata; set format y; set offsets 0, 0, 0, 0");
}

}  // namespace

bool has_series(const MeasuredOutcome& fit) {
  return std::ranges::none_of(fit.scans,
                              [](const MeasuredScan& scan) { return scan.time_utc.empty(); }) &&
         !series_of({&fit, 1}).empty();
}

Figure series_figure(std::span<const MeasuredOutcome> fits, const Sheet& sheet) {
  const std::map<std::string, Series> all = series_of(fits);
  if (all.empty())
    throw std::invalid_argument(
        "figure series: no unknown of two scans: expected a fit with --per-scan, or several fits "
        "of single scans");
  std::vector<std::string> names;
  for (const auto& [name, series] : all) names.push_back(name);
  const std::vector<std::size_t> rows = sheet.chosen(names);
  std::string first = all.begin()->second.points.front().time_utc, last = first;
  for (const auto& [name, series] : all) {
    first = std::min(first, series.points.front().time_utc);
    last = std::max(last, series.points.back().time_utc);
  }
  constexpr std::size_t kDate = 10;  // characters
  const std::string first_day = first.substr(0, kDate), last_day = last.substr(0, kDate);
  const bool one_day = first_day == last_day;
  const double width = sheet.width_px(kWidth), left = sheet.on_page() ? 62 : 96,
               right = sheet.on_page() ? 18 : kRight;
  const double plot_width = width - left - right;
  const double footer = (sheet.on_page() ? 44 : 62) + (plot_width < kNarrow ? 30 : 0);
  const Header header(sheet, width,
                      one_day ? fmt::format("Unknowns over {}", first_day)
                              : fmt::format("Unknowns, {} to {}", first_day, last_day),
                      "error bars: one sigma");
  const double row_px = sheet.on_page() ? std::clamp(0.35 * width, 110.0, kRow) : kRow;
  const double height = header.height_px() + row_px * static_cast<double>(rows.size()) + footer;
  Script script(width, height, sheet);
  script.line("set multiplot");
  script.begin_axes({0, 0, width, height});
  header.draw(script);
  script.text_label(left + plot_width / 2, sheet.on_page() ? 10 : 18, "time, UTC",
                    "center font axis_font");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const double top = height - header.height_px() - row_px * static_cast<double>(row);
    const std::string& name = names[rows[row]];
    draw_panel(script, {left, top - row_px + kGap / 2, plot_width, row_px - kGap}, name,
               all.at(name), row, one_day ? "%H:%M" : "%Y-%m-%d", row + 1 == rows.size());
  }
  script.line("unset multiplot");
  return figure_of(script);
}

}  // namespace skyfit::plot
