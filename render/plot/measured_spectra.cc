// SPDX-License-Identifier: Apache-2.0
// Spectra at up to six directions of one scan.
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "render/plot/header.h"
#include "render/plot/measured_figures.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kWidth = 1200, kRow = 250;
constexpr double kLeastColumn = 148;              // on a page
constexpr double kNearZenith = 15, kNear90 = 10;  // deg, that a name still holds
constexpr double kGap = 18;                       // above a panel and its names, and beside it

struct Chosen {
  std::string meaning;
  MeasuredDirection direction;
};

double azimuth_distance(const MeasuredDirection& d, double azimuth_deg) {
  return std::abs(std::remainder(d.relative_azimuth_deg - azimuth_deg, 360.0));
}

// Takes directions one by one out of those that are left.
struct Chooser {
  std::vector<MeasuredDirection> left;
  std::vector<Chosen> chosen;

  // The one with the smallest cost, if its name is true of it.
  template <class Cost, class Holds>
  void take(const std::string& meaning, const Cost& cost, const Holds& holds) {
    if (left.empty()) return;
    const auto best = std::ranges::min_element(left, {}, cost);
    if (!holds(*best)) return;
    chosen.push_back({meaning, *best});
    left.erase(best);
  }

  // The lowest, more or less, about an azimuth from the sun.
  void take_low(const std::string& meaning, double azimuth_deg) {
    constexpr double kLow = 45, kAbout = 45;  // deg
    take(
        "low, " + meaning,
        [&](const auto& d) { return azimuth_distance(d, azimuth_deg) - 3 * d.view_zenith_deg; },
        [&](const auto& d) {
          return d.view_zenith_deg >= kLow && azimuth_distance(d, azimuth_deg) <= kAbout;
        });
  }
};

std::vector<Chosen> chosen_directions(const MeasuredOutcome& outcome, int scan) {
  Chooser chooser;
  for (const MeasuredDirection& d : directions_of(outcome)) {
    if (d.scan == scan && d.counted) chooser.left.push_back(d);
  }
  if (chooser.left.empty())
    throw std::invalid_argument(
        fmt::format("figure spectra: scan {}: expected 1 to {}, with fitted "
                    "samples",
                    scan, outcome.scans.size()));
  const auto from_90 = [](const auto& d) { return std::abs(d.scattering_angle_deg - 90); };
  chooser.take(
      "nearest to the sun", [](const auto& d) { return d.scattering_angle_deg; },
      [](const auto&) { return true; });
  chooser.take(
      "zenith", [](const auto& d) { return d.view_zenith_deg; },
      [](const auto& d) { return d.view_zenith_deg <= kNearZenith; });
  chooser.take("90° from the sun", from_90, [&](const auto& d) { return from_90(d) <= kNear90; });
  chooser.take_low("toward the sun", 0);
  chooser.take_low("across", 90);
  chooser.take_low("away from the sun", 180);
  return std::move(chooser.chosen);
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

std::string place_of(const MeasuredDirection& d) {
  const std::string azimuth =
      d.view_zenith_deg > 0 ? fmt::format("azimuth {:.0f}°, ", d.relative_azimuth_deg) : "";
  return fmt::format("zenith {:.0f}°, {}{:.0f}° from the sun", d.view_zenith_deg, azimuth,
                     d.scattering_angle_deg);
}

void draw_panel(Script& script, const Chosen& chosen, const Box& box, std::size_t index,
                const MeasuredOutcome& outcome, double names_width) {
  script.begin_axes(box);
  const double middle = box.left + box.width / 2, line = script.sheet().on_page() ? 15 : 16;
  const std::vector<std::string> place =
      wrapped(place_of(chosen.direction), names_width, script.sheet());
  for (std::size_t i = 0; i < place.size(); ++i)
    script.text_label(middle, box.top() + 10 + line * static_cast<double>(place.size() - 1 - i),
                      place[i], "center font small_font textcolor rgb '#404040'");
  script.text_label(middle, box.top() + 10 + line * static_cast<double>(place.size()),
                    chosen.meaning, "center font text_font");
  script.line("set border 3 lc rgb '{}'; set grid lc rgb '{}' lt 1; set yrange [0:*]", kFrameColor,
              kGridColor);
  script.line(
      "{}; set xtics {} nomirror textcolor rgb '#202020'; set ytics nomirror "
      "textcolor rgb '#202020'",
      wavelength_range(outcome), wavelength_step(outcome, box.width));
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

Figure spectra_figure(const MeasuredOutcome& outcome, int scan, const Sheet& sheet) {
  if (!outcome.spectral)
    throw std::invalid_argument("figure spectra: the fit is of luminances, expected spectra");
  const std::vector<Chosen> all = chosen_directions(outcome, scan);
  std::vector<std::string> names;
  for (const Chosen& direction : all) names.push_back(direction.meaning);
  std::vector<Chosen> chosen;
  for (const std::size_t place : sheet.chosen(names)) chosen.push_back(all[place]);

  const double width = sheet.width_px(kWidth);
  const double left = sheet.on_page() ? 62 : 84, footer = sheet.on_page() ? 40 : 60;
  const std::size_t columns =
      sheet.on_page()
          ? std::clamp<std::size_t>(static_cast<std::size_t>((width - left) / kLeastColumn), 1, 3)
          : 3;
  Grid grid{std::min(columns, chosen.size()), 1, {left, footer, width - left - 10, 0}};
  grid.rows = (chosen.size() + grid.columns - 1) / grid.columns;
  // What the cell of a column holds beside the panel: the tick labels of the next.
  const double panel_width =
      grid.area.width / static_cast<double>(grid.columns) - (sheet.on_page() ? 44 : 35);
  const double names_width = sheet.on_page() ? panel_width + 36 : panel_width;
  std::size_t lines = 1;
  for (const Chosen& direction : chosen)
    lines = std::max(lines, wrapped(place_of(direction.direction), names_width, sheet).size());
  const double names_px = 16 * static_cast<double>(lines + 1) + kGap;
  const double panel_height = sheet.on_page() ? std::clamp(0.8 * panel_width, 110.0, kRow) : kRow;
  const double row = panel_height + names_px + kGap;
  grid.area.height = row * static_cast<double>(grid.rows);
  const Header header(
      sheet, width, fmt::format("Spectra, {}", scan_label(outcome, scan)),
      "band: one standard deviation of a single sample, as the residuals of the whole fit show it",
      {{Mark::kPoint, kReferenceColor, "measured"},
       {Mark::kHollowPoint, kLeftOutColor, "not fitted (absorption bands)"},
       {Mark::kSolidLine, kCurveColors[0], "model"}});
  Script script(width, footer + grid.area.height + header.height_px(), sheet);
  script.line("set multiplot");
  for (std::size_t i = 0; i < chosen.size(); ++i)
    write_data(script, outcome, chosen[i].direction, i);
  script.begin_axes({0, 0, width, script.height()});
  header.draw(script);
  script.upright_lines(sheet.on_page() ? 10 : 20, footer + grid.area.height / 2, grid.area.height,
                       "spectral radiance, mW m⁻² sr⁻¹ nm⁻¹", "font axis_font");
  script.text_label(width / 2, sheet.on_page() ? 10 : 16, "wavelength, nm",
                    "center font axis_font");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const Box cell = grid.cell(i);
    draw_panel(script, chosen[i], {cell.left, cell.bottom + kGap, panel_width, panel_height}, i,
               outcome, names_width);
  }
  script.line("unset multiplot");
  return figure_of(script);
}

}  // namespace skyfit::plot
