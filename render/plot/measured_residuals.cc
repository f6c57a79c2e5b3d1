// SPDX-License-Identifier: Apache-2.0
// Residuals against scattering angle, view zenith and wavelength.
#include <algorithm>
#include <cmath>
#include <map>

#include "model/base/misfit.h"
#include "render/plot/header.h"
#include "render/plot/measured_figures.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kWidth = 1200, kPanel = 330;
constexpr double kBeside = 20;        // a title may be wider than its panel
constexpr std::size_t kMaxScans = 4;  // colours that stay apart; further scans repeat them

std::string_view color_of(int scan) {
  return kCurveColors[static_cast<std::size_t>(scan - 1) % kMaxScans];
}

// 100 (model / measured - 1).
double percent(double model, double measured) { return 100 * (model / measured - 1); }

void write_directions(Script& script, const MeasuredOutcome& outcome) {
  std::map<int, std::vector<MeasuredDirection>> of_scan;
  for (const MeasuredDirection& d : directions_of(outcome)) {
    if (d.counted && d.measured > 0) of_scan[d.scan].push_back(d);
  }
  for (std::size_t s = 0; s < outcome.scans.size(); ++s) {
    script.line("$scan{} << EOD", s + 1);
    for (const MeasuredDirection& d : of_scan[static_cast<int>(s) + 1])
      script.line("{:.6g} {:.6g} {:.6g}", d.scattering_angle_deg, d.view_zenith_deg,
                  percent(d.model, d.measured));
    script.line("NaN NaN NaN\nEOD");
  }
}

struct Mean {
  double sum = 0, squares = 0, count = 0;
  double average() const { return sum / count; }
};

// In percent, by wavelength in nm.
std::map<double, Mean> means_of(const MeasuredOutcome& outcome) {
  std::map<double, Mean> at;
  for (const Sample& s : outcome.samples) {
    if (!(s.weight > 0 && s.reference > 0)) continue;
    Mean& mean = at[s.wavelength_nm];
    const double value = percent(s.model, s.reference);
    mean.sum += value;
    mean.squares += value * value;
    ++mean.count;
  }
  return at;
}

// Wavelength, mean, standard deviation over the directions.
void write_wavelengths(Script& script, const MeasuredOutcome& outcome) {
  script.line("$wavelengths << EOD");
  for (const auto& [nm, mean] : means_of(outcome)) {
    const double variance = mean.squares / mean.count - mean.average() * mean.average();
    script.line("{:.6g} {:.6g} {:.6g}", nm, mean.average(), std::sqrt(std::max(0.0, variance)));
  }
  script.line("EOD");
}

// Half the height of the panels, the same in all: all but 2 % of the directions lie within, and
// the means of spectral samples.
double limit_percent(const MeasuredOutcome& outcome) {
  std::vector<double> sizes = {1};
  for (const MeasuredDirection& d : directions_of(outcome)) {
    if (d.counted && d.measured > 0) sizes.push_back(std::abs(percent(d.model, d.measured)));
  }
  const auto rank = static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, sizes.begin() + rank);
  constexpr double kLeast = 0.1;  // what a fit of its own model leaves is rounding
  double limit = std::max(sizes[static_cast<std::size_t>(rank)], kLeast);
  if (outcome.spectral) {
    for (const auto& [nm, mean] : means_of(outcome))
      limit = std::max(limit, std::abs(mean.average()));
  }
  return round_up(limit);
}

// Percents around 0, or factors around 1 on a logarithmic axis where percents are large.
struct Axis {
  double limit_percent;
  bool is_factor;
  double upper() const { return is_factor ? round_up(1 + limit_percent / 100) : limit_percent; }
  double lower() const { return is_factor ? 1 / upper() : -limit_percent; }
  // gnuplot's expression of a value that is in percent.
  std::string shown(std::string_view percent) const {
    return is_factor ? fmt::format("(1+({})/100.0)", percent) : fmt::format("({})", percent);
  }
};

Axis axis_of(const MeasuredOutcome& outcome) {
  const double limit = limit_percent(outcome);
  return {limit, is_factor(limit)};
}

void begin_panel(Script& script, const Box& box, std::string_view title, const Axis& axis) {
  script.begin_axes(box);
  script.text_lines(box.left + box.width / 2, box.bottom - (script.sheet().on_page() ? 30 : 40),
                    box.width + kBeside, title, "center font text_font");
  script.line(
      "set border 3 lc rgb '{}'; set grid lc rgb '{}' lt 1; set autoscale x; set yrange "
      "[{:.6g}:{:.6g}]",
      kFrameColor, kGridColor, axis.lower(), axis.upper());
  if (axis.is_factor) script.line("set logscale y");
  script.line(
      "set xtics autofreq nomirror textcolor rgb '#202020'; set ytics nomirror textcolor rgb "
      "'#202020'; set arrow from graph 0, first {0} to graph 1, first {0} nohead lc rgb "
      "'#404040' lw 1 back",
      axis.is_factor ? 1 : 0);
}

void draw_scans(Script& script, const MeasuredOutcome& outcome, int column, const Axis& axis) {
  std::string plots;
  for (std::size_t s = 0; s < outcome.scans.size(); ++s) {
    plots += fmt::format("{}$scan{} using {}:{} with points pt 7 ps 0.5 lc rgb '{}' notitle",
                         s == 0 ? "" : ", ", s + 1, column, axis.shown("$3"),
                         color_of(static_cast<int>(s) + 1));
  }
  script.line("plot {}", plots);
}

// What stands at the axis of each panel, which is also its name.
std::vector<std::string> panel_titles(const MeasuredOutcome& outcome) {
  std::vector<std::string> titles = {"luminance: scattering angle, °", "luminance: view zenith, °"};
  if (outcome.spectral) titles.emplace_back("radiance: wavelength, nm (mean ± scatter)");
  return titles;
}

void draw_panel(Script& script, const MeasuredOutcome& outcome, const Box& box, std::size_t panel,
                const Axis& axis) {
  begin_panel(script, box, panel_titles(outcome)[panel], axis);
  if (panel == 0) {
    if (script.sheet().on_page()) script.line("set xtics {}", box.width < 200 ? 60 : 30);
    return draw_scans(script, outcome, 1, axis);
  }
  if (panel == 1) {
    script.line("set xrange [-3:93]; set xtics 30");  // the zenith does not lie on the axis
    return draw_scans(script, outcome, 2, axis);
  }
  script.line("{}", wavelength_range(outcome));
  script.line("set xtics {}", wavelength_step(outcome, box.width));
  // gnuplot fills beyond the panel what leaves it.
  script.line("inside(y) = y < {0:.9g} ? {0:.9g} : y > {1:.9g} ? {1:.9g} : y", axis.lower(),
              axis.upper());
  script.line(
      "plot $wavelengths using 1:(inside({})):(inside({})) with filledcurves fc rgb '#d8d8d8' "
      "notitle, $wavelengths using 1:{} with linespoints lw 2 pt 7 ps 0.5 lc rgb '{}' notitle",
      axis.shown("$2-$3"), axis.shown("$2+$3"), axis.shown("$2"), kReferenceColor);
}

}  // namespace

Figure residuals_figure(const MeasuredOutcome& outcome, const Sheet& sheet) {
  const std::vector<std::size_t> panels = sheet.chosen(panel_titles(outcome));
  const Axis axis = axis_of(outcome);
  const double width = sheet.width_px(kWidth);
  const double left = sheet.on_page() ? 62 : 74;
  // The title of the third is 41 characters long.
  const std::size_t columns =
      sheet.on_page() ? std::clamp<std::size_t>(static_cast<std::size_t>((width - left) / 290), 1,
                                                panels.size())
                      : panels.size();
  const std::size_t rows = (panels.size() + columns - 1) / columns;
  // Beside a panel the numbers of the next.
  const double gap = !sheet.on_page() ? 46 : columns > 1 ? 52 : 14;
  const double panel_width = (width - left - 10) / static_cast<double>(columns) - gap;
  std::size_t lines = 1;
  for (const std::string& title : panel_titles(outcome))
    lines = std::max(lines, wrapped(title, panel_width + kBeside, sheet).size());
  const double footer =
      (sheet.on_page() ? 46 : 62) + sheet.line_px() * static_cast<double>(lines - 1);
  std::vector<LegendEntry> legend;
  for (std::size_t s = 0; s < std::min(kMaxScans, outcome.scans.size()); ++s)
    legend.push_back({Mark::kPoint, color_of(static_cast<int>(s) + 1),
                      scan_label(outcome, static_cast<int>(s) + 1)});
  const Header header(sheet, width, "Residuals, " + short_name(outcome.title), "", legend);
  const double panel = sheet.on_page() ? 170 : kPanel, row = panel + footer;
  const double height = header.height_px() + row * static_cast<double>(rows);
  Script script(width, height, sheet);
  script.line("set multiplot");
  write_directions(script, outcome);
  if (outcome.spectral) write_wavelengths(script, outcome);
  script.begin_axes({0, 0, width, height});
  header.draw(script);
  script.upright_lines(sheet.on_page() ? 10 : 20, (height - header.height_px() + footer) / 2,
                       height, axis.is_factor ? "model / measured" : "model / measured − 1, %",
                       "font axis_font");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  const Grid grid{columns, rows, {left, 0, width - left - 10, row * static_cast<double>(rows)}};
  for (std::size_t k = 0; k < panels.size(); ++k) {
    const Box cell = grid.cell(k);
    draw_panel(script, outcome, {cell.left, cell.bottom + footer, panel_width, panel}, panels[k],
               axis);
  }
  script.line("unset multiplot");
  return figure_of(script);
}

}  // namespace skyfit::plot
