// SPDX-License-Identifier: Apache-2.0
// Residuals against scattering angle, view zenith and wavelength.
#include <algorithm>
#include <cmath>
#include <map>

#include "render/plot/legend.h"
#include "render/plot/measured_figures.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kWidth = 1200, kHeader = 92, kFooter = 62, kPanel = 330, kLeft = 74, kGap = 62;
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
};

// Wavelength, mean, standard deviation over the directions.
void write_wavelengths(Script& script, const MeasuredOutcome& outcome) {
  std::map<double, Mean> at;
  for (const Sample& s : outcome.samples) {
    if (!(s.weight > 0 && s.reference > 0)) continue;
    Mean& mean = at[s.wavelength_nm];
    const double value = percent(s.model, s.reference);
    mean.sum += value;
    mean.squares += value * value;
    ++mean.count;
  }
  script.line("$wavelengths << EOD");
  for (const auto& [nm, mean] : at) {
    const double average = mean.sum / mean.count;
    script.line("{:.6g} {:.6g} {:.6g}", nm, average,
                std::sqrt(std::max(0.0, mean.squares / mean.count - average * average)));
  }
  script.line("EOD");
}

// Half the height of the panels, the same in all: all but 2 % of the directions lie within.
double limit_percent(const MeasuredOutcome& outcome) {
  std::vector<double> sizes = {1};
  for (const MeasuredDirection& d : directions_of(outcome)) {
    if (d.counted && d.measured > 0) sizes.push_back(std::abs(percent(d.model, d.measured)));
  }
  const auto rank = static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(sizes.size() - 1));
  std::ranges::nth_element(sizes, sizes.begin() + rank);
  constexpr double kLeast = 0.1;  // what a fit of its own model leaves is rounding
  return round_up(std::max(sizes[static_cast<std::size_t>(rank)], kLeast));
}

void begin_panel(Script& script, const Box& box, std::string_view title, double limit) {
  script.begin_axes(box);
  script.text_label(box.left + box.width / 2, box.bottom - 40, title, "center font ',12'");
  script.line(
      "set border 3 lc rgb '{}'; set grid lc rgb '{}' lt 1; set autoscale x; set yrange "
      "[{:.6g}:{:.6g}]",
      kFrameColor, kGridColor, -limit, limit);
  script.line(
      "set xtics autofreq nomirror textcolor rgb '#202020'; set ytics nomirror textcolor rgb "
      "'#202020'; set arrow from graph 0, first 0 to graph 1, first 0 nohead lc rgb "
      "'#404040' lw 1 back");
}

void draw_scans(Script& script, const MeasuredOutcome& outcome, int column) {
  std::string plots;
  for (std::size_t s = 0; s < outcome.scans.size(); ++s) {
    plots += fmt::format("{}$scan{} using {}:3 with points pt 7 ps 0.5 lc rgb '{}' notitle",
                         s == 0 ? "" : ", ", s + 1, column, color_of(static_cast<int>(s) + 1));
  }
  script.line("plot {}", plots);
}

}  // namespace

Figure residuals_figure(const MeasuredOutcome& outcome) {
  const double height = kHeader + kPanel + kFooter, limit = limit_percent(outcome);
  Script script(kWidth, height);
  script.line("set multiplot");
  write_directions(script, outcome);
  if (outcome.spectral) write_wavelengths(script, outcome);
  script.begin_axes({0, 0, kWidth, height});
  script.text_label(16, height - 24, "Residuals, " + short_name(outcome.title), "left font ',18'");
  script.text_label(20, kFooter + kPanel / 2, "model / measured − 1, %",
                    "center rotate by 90 font ',13'");
  std::vector<LegendEntry> legend;
  for (std::size_t s = 0; s < std::min(kMaxScans, outcome.scans.size()); ++s)
    legend.push_back({Mark::kPoint, color_of(static_cast<int>(s) + 1),
                      scan_label(outcome, static_cast<int>(s) + 1)});
  draw_legend(script, legend, kWidth / 2, height - 54);
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  const Grid grid{outcome.spectral ? 3u : 2u, 1, {kLeft, kFooter, kWidth - kLeft - 10, kPanel}};
  const auto box = [&](std::size_t k) {
    const Box cell = grid.cell(k);
    return Box{cell.left, cell.bottom, cell.width - kGap / 2, cell.height};
  };
  begin_panel(script, box(0), "luminance: scattering angle, °", limit);
  draw_scans(script, outcome, 1);
  begin_panel(script, box(1), "luminance: view zenith, °", limit);
  script.line("set xrange [-3:93]; set xtics 30");  // the zenith does not lie on the axis
  draw_scans(script, outcome, 2);
  if (outcome.spectral) {
    begin_panel(script, box(2), "radiance: wavelength, nm (mean ± scatter)", limit);
    script.line("{}", wavelength_range(outcome));
    script.line(
        "plot $wavelengths using 1:($2-$3):($2+$3) with filledcurves fc rgb '#d8d8d8' "
        "notitle, $wavelengths using 1:2 with linespoints lw 2 pt 7 ps 0.5 lc rgb '{}' "
        "notitle",
        kReferenceColor);
  }
  script.line("unset multiplot");
  return {kWidth, height, script.text()};
}

}  // namespace skyfit::plot
