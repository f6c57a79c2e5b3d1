// SPDX-License-Identifier: Apache-2.0
// Spectra at six directions of one scan.
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "render/plot/legend.h"
#include "render/plot/measured_figures.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kWidth = 1200, kHeader = 64, kFooter = 60, kRow = 320, kLeft = 84, kGap = 70;

struct Chosen {
  std::string meaning;
  MeasuredDirection direction;
};

// The direction with the smallest cost.
template <class Cost>
void choose(std::vector<Chosen>& chosen, const std::vector<MeasuredDirection>& all,
            std::string_view meaning, const Cost& cost) {
  const auto best = std::ranges::min_element(all, {}, cost);
  chosen.push_back({std::string(meaning), *best});
}

double azimuth_distance(const MeasuredDirection& d, double azimuth_deg) {
  return std::abs(std::remainder(d.relative_azimuth_deg - azimuth_deg, 360.0));
}

std::vector<Chosen> chosen_directions(const MeasuredOutcome& outcome, int scan) {
  std::vector<MeasuredDirection> all;
  for (const MeasuredDirection& d : directions_of(outcome)) {
    if (d.scan == scan && d.counted) all.push_back(d);
  }
  if (all.empty())
    throw std::invalid_argument(
        fmt::format("figure spectra: scan {}: expected 1 to {}, with fitted "
                    "samples",
                    scan, outcome.scans.size()));
  std::vector<Chosen> chosen;
  choose(chosen, all, "near the sun", [](const auto& d) { return d.scattering_angle_deg; });
  choose(chosen, all, "zenith", [](const auto& d) { return d.view_zenith_deg; });
  choose(chosen, all, "90° from the sun",
         [](const auto& d) { return std::abs(d.scattering_angle_deg - 90); });
  const auto low = [](const MeasuredDirection& d, double azimuth_deg) {
    return azimuth_distance(d, azimuth_deg) - 3 * d.view_zenith_deg;
  };
  choose(chosen, all, "low, toward the sun", [&](const auto& d) { return low(d, 0); });
  choose(chosen, all, "low, across", [&](const auto& d) { return low(d, 90); });
  choose(chosen, all, "low, away from the sun", [&](const auto& d) { return low(d, 180); });
  return chosen;
}

// Columns: wavelength, measured, sigma, model, fitted or not.
void write_data(Script& script, const MeasuredOutcome& outcome, const MeasuredDirection& d,
                std::size_t index) {
  std::map<double, const Sample*> spectrum;
  const DirectionKey wanted =
      direction_key(d.scan, d.sun_zenith_deg, d.view_zenith_deg, d.relative_azimuth_deg);
  for (const Sample& s : outcome.samples) {
    if (direction_key(s.scan, s.sun_zenith_deg, s.view_zenith_deg, s.relative_azimuth_deg) ==
        wanted)
      spectrum[s.wavelength_nm] = &s;
  }
  script.line("$spectrum{} << EOD", index);
  for (const auto& [nm, s] : spectrum)
    script.line("{:.6g} {:.6g} {:.6g} {:.6g} {}", nm, 1e3 * s->reference, 1e3 * s->sigma,
                1e3 * s->model, s->weight > 0 ? 1 : 0);
  script.line("EOD");
}

void draw_panel(Script& script, const Chosen& chosen, const Box& box, std::size_t index,
                const std::string& x_range) {
  script.begin_axes(box);
  const MeasuredDirection& d = chosen.direction;
  script.text_label(box.left + box.width / 2, box.top() + 26, chosen.meaning, "center font ',12'");
  const std::string azimuth =
      d.view_zenith_deg > 0 ? fmt::format("azimuth {:.0f}°, ", d.relative_azimuth_deg) : "";
  script.text_label(box.left + box.width / 2, box.top() + 10,
                    fmt::format("zenith {:.0f}°, {}{:.0f}° from the sun", d.view_zenith_deg,
                                azimuth, d.scattering_angle_deg),
                    "center font ',10' textcolor rgb '#404040'");
  script.line("set border 3 lc rgb '{}'; set grid lc rgb '{}' lt 1; set yrange [0:*]", kFrameColor,
              kGridColor);
  script.line(
      "{}; set xtics 100 nomirror textcolor rgb '#202020'; set ytics nomirror "
      "textcolor rgb '#202020'",
      x_range);
  const std::string data = fmt::format("$spectrum{}", index);
  script.line(
      "plot {0} using 1:($5>0?$2-$3:NaN):($5>0?$2+$3:NaN) with filledcurves fc rgb '#d8d8d8' "
      "notitle, {0} using 1:4 with lines {1} notitle, {0} using 1:($5>0?$2:NaN) with points {2} "
      "notitle, {0} using 1:($5>0?NaN:$2) with points {3} notitle",
      data, mark_style(Mark::kSolidLine, kCurveColors[0]),
      "pt 7 ps 0.6 lc rgb '" + std::string(kReferenceColor) + "'",
      mark_style(Mark::kHollowPoint, kLeftOutColor));
}

}  // namespace

Figure spectra_figure(const MeasuredOutcome& outcome, int scan) {
  if (!outcome.spectral)
    throw std::invalid_argument("figure spectra: the fit is of luminances, expected spectra");
  const std::vector<Chosen> chosen = chosen_directions(outcome, scan);
  const double height = kHeader + 2 * kRow + kFooter;
  Script script(kWidth, height);
  script.line("set multiplot");
  for (std::size_t i = 0; i < chosen.size(); ++i)
    write_data(script, outcome, chosen[i].direction, i);
  script.begin_axes({0, 0, kWidth, height});
  script.text_label(16, height - 24, fmt::format("Spectra, {}", scan_label(outcome, scan)),
                    "left font ',18'");
  script.text_label(
      16, height - 48,
      "band: one standard deviation of a single sample, as the residuals of the whole "
      "fit show it",
      "left font ',12' textcolor rgb '#404040'");
  script.text_label(20, kFooter + kRow, "spectral radiance, mW m⁻² sr⁻¹ nm⁻¹",
                    "center rotate by 90 font ',13'");
  script.text_label(kWidth / 2, 16, "wavelength, nm", "center font ',13'");
  draw_legend(script,
              {{Mark::kPoint, kReferenceColor, "measured"},
               {Mark::kHollowPoint, kLeftOutColor, "not fitted (absorption bands)"},
               {Mark::kSolidLine, kCurveColors[0], "model"}},
              kWidth - 330, height - 24);
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  const Grid grid{3, 2, {kLeft, kFooter, kWidth - kLeft - 10, 2 * kRow}};
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    Box box = grid.cell(i);
    draw_panel(script, chosen[i], {box.left, box.bottom, box.width - kGap / 2, box.height - kGap},
               i, wavelength_range(outcome));
  }
  script.line("unset multiplot");
  return {kWidth, height, script.text()};
}

}  // namespace skyfit::plot
