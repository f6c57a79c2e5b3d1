// SPDX-License-Identifier: Apache-2.0
// Unknowns over the time of their scans: those of one scan each, of one fit or of several.
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "render/plot/measured_figures.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kWidth = 1080, kHeader = 76, kFooter = 62, kRow = 170, kLeft = 96, kRight = 48,
                 kGap = 46;

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

// Where the only scan of a fit has the unknown, its own and a shared one are the same.
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
  if (result.empty())
    throw std::invalid_argument(
        "figure series: no unknown of two scans: expected a fit with --per-scan, or several fits "
        "of single scans");
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
                    series.unit == "1" ? name : fmt::format("{}, {}", name, series.unit),
                    "left font ',12'");
  script.line(
      "set border 3 lc rgb '{}'; set grid lc rgb '{}' lt 1; set xdata time; set timefmt "
      "'%Y-%m-%dT%H:%M:%SZ'",
      kFrameColor, kGridColor);
  script.line(
      "set xtics format '{}' nomirror textcolor rgb '#202020'; set ytics nomirror "
      "textcolor rgb '#202020'",
      last ? time_format : "");
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

Figure series_figure(std::span<const MeasuredOutcome> fits) {
  const std::map<std::string, Series> all = series_of(fits);
  const double height = kHeader + kRow * static_cast<double>(all.size()) + kFooter;
  Script script(kWidth, height);
  script.line("set multiplot");
  script.begin_axes({0, 0, kWidth, height});
  std::string first = all.begin()->second.points.front().time_utc, last = first;
  for (const auto& [name, series] : all) {
    first = std::min(first, series.points.front().time_utc);
    last = std::max(last, series.points.back().time_utc);
  }
  constexpr std::size_t kDate = 10;  // characters
  const std::string first_day = first.substr(0, kDate), last_day = last.substr(0, kDate);
  const bool one_day = first_day == last_day;
  script.text_label(16, height - 24,
                    one_day ? fmt::format("Unknowns over {}", first_day)
                            : fmt::format("Unknowns, {} to {}", first_day, last_day),
                    "left font ',18'");
  script.text_label(16, height - 48, "error bars: one sigma",
                    "left font ',12' textcolor rgb '#404040'");
  script.text_label((kLeft + kWidth - kRight) / 2, 18, "time, UTC", "center font ',13'");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  std::size_t row = 0;
  for (const auto& [name, series] : all) {
    const double top = height - kHeader - kRow * static_cast<double>(row);
    draw_panel(script, {kLeft, top - kRow + kGap / 2, kWidth - kLeft - kRight, kRow - kGap}, name,
               series, row, one_day ? "%H:%M" : "%Y-%m-%d", row + 1 == all.size());
    ++row;
  }
  script.line("unset multiplot");
  return {kWidth, height, script.text()};
}

}  // namespace skyfit::plot
