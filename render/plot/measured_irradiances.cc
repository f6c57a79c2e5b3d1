// SPDX-License-Identifier: Apache-2.0
// Irradiances against the sun's zenith angle, and below what the model is off.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/irradiance.h"
#include "render/plot/header.h"
#include "render/plot/measured_figures.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kColumn = 330, kValues = 260, kRatios = 170;

// "direct normal"
std::string words_of(std::string_view name) {
  std::string words(name);
  std::ranges::replace(words, '_', ' ');
  return words;
}

// The kinds that were measured, in the order of Irradiance.
std::vector<std::string_view> kinds_of(const MeasuredOutcome& outcome) {
  std::vector<std::string_view> kinds;
  for (const std::string_view name : kIrradianceNames) {
    if (std::ranges::count(outcome.irradiances, name, &Sample::irradiance) > 0)
      kinds.push_back(name);
  }
  return kinds;
}

// Sun zenith angle, measured, sigma, model, percent, sigma in percent; by sun.
void write_samples(Script& script, const MeasuredOutcome& outcome, std::string_view kind,
                   std::size_t index) {
  std::vector<Sample> samples;
  for (const Sample& s : outcome.irradiances) {
    if (s.irradiance == kind && s.reference > 0 && s.weight > 0) samples.push_back(s);
  }
  std::ranges::sort(samples, {}, &Sample::sun_zenith_deg);
  script.line("$kind{} << EOD", index);
  for (const Sample& s : samples) {
    script.line("{:.6g} {:.9g} {:.6g} {:.9g} {:.6g} {:.6g}", s.sun_zenith_deg, s.reference, s.sigma,
                s.model, 100 * (s.model / s.reference - 1), 100 * s.sigma / s.reference);
  }
  script.line("NaN NaN NaN NaN NaN NaN\nEOD");
}

// The same in all panels: measured and model within one sigma more than their largest difference.
double limit_percent(const MeasuredOutcome& outcome) {
  double most = 1;
  for (const Sample& s : outcome.irradiances) {
    if (s.reference > 0 && s.weight > 0)
      most = std::max(most, 100 * (std::abs(s.model / s.reference - 1) + s.sigma / s.reference));
  }
  return round_up(most);
}

void begin_panel(Script& script, const Box& box, bool with_suns) {
  script.begin_axes(box);
  script.line("set border 3 lc rgb '{}'; set grid lc rgb '{}' lt 1; set xrange [0:90]", kFrameColor,
              kGridColor);
  script.line(
      "set xtics {} nomirror textcolor rgb '#202020' format '{}'; set ytics nomirror textcolor rgb "
      "'#202020'",
      script.sheet().on_page() ? 30 : 15, with_suns ? "%g" : "");
}

void draw_kind(Script& script, const Box& values, const Box& ratios, std::string_view kind,
               std::size_t index, double limit) {
  begin_panel(script, values, false);
  script.text_label(values.left + 6, values.top() + 15, words_of(kind), "left font text_font");
  script.line("set yrange [0:*]");
  script.line(
      "plot $kind{0} using 1:2:3 with yerrorbars pt 7 ps 0.7 lw 1.4 lc rgb '{1}' notitle, $kind{0} "
      "using 1:4 with points pt 6 ps 1.3 lw 1.8 lc rgb '{2}' notitle",
      index, kReferenceColor, kCurveColors[0]);
  begin_panel(script, ratios, true);
  script.line("set yrange [{:.6g}:{:.6g}]", -limit, limit);
  script.line(
      "plot 0 lc rgb '#404040' lw 1 notitle, $kind{0} using 1:5:6 with yerrorbars pt 6 ps 1.3 lw "
      "1.4 lc rgb '{1}' notitle",
      index, kCurveColors[0]);
}

}  // namespace

Figure irradiances_figure(const MeasuredOutcome& outcome, const Sheet& sheet) {
  const std::vector<std::string_view> all = kinds_of(outcome);
  if (all.empty()) throw std::invalid_argument("figure irradiances: expected a fit of irradiances");
  std::vector<std::string> names;
  for (const std::string_view kind : all) names.push_back(words_of(kind));
  std::vector<std::string_view> kinds;
  for (const std::size_t place : sheet.chosen(names)) kinds.push_back(all[place]);

  const double left = sheet.on_page() ? 74 : 92, footer = sheet.on_page() ? 44 : 62,
               gap = sheet.on_page() ? 46 : 62;
  const double width =
      sheet.width_px(left + kColumn * std::max(2.0, static_cast<double>(kinds.size())));
  const std::size_t columns =
      sheet.on_page()
          ? std::clamp<std::size_t>(static_cast<std::size_t>((width - left) / 170), 1, kinds.size())
          : kinds.size();
  const std::size_t rows = (kinds.size() + columns - 1) / columns;
  const double column = sheet.on_page() ? (width - left) / static_cast<double>(columns) : kColumn;
  const double values = sheet.on_page() ? 170 : kValues, ratios = sheet.on_page() ? 120 : kRatios;
  const double row = values + ratios + footer;
  const Header header(sheet, width, "Irradiances, " + short_name(outcome.title), "",
                      {{Mark::kPoint, kReferenceColor, "measured, one sigma"},
                       {Mark::kHollowPoint, kCurveColors[0], "fitted"}});
  const double height = header.height_px() + row * static_cast<double>(rows);
  const double limit = limit_percent(outcome);
  Script script(width, height, sheet);
  script.line("set multiplot");
  for (std::size_t k = 0; k < kinds.size(); ++k) write_samples(script, outcome, kinds[k], k);
  script.begin_axes({0, 0, width, height});
  header.draw(script);
  for (std::size_t r = 0; r < rows; ++r) {
    const double bottom = row * static_cast<double>(r) + footer;
    script.upright_lines(sheet.on_page() ? 8 : 16, bottom + ratios + values / 2 - gap / 4, values,
                         outcome.irradiance_unit, "font axis_font");
    script.upright_lines(sheet.on_page() ? 8 : 16, bottom + ratios / 2 - gap / 4, ratios,
                         "model / measured − 1, %", "font axis_font");
  }
  script.text_label(width / 2, sheet.on_page() ? 10 : 18, "sun zenith, °", "center font axis_font");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const double x = left + column * static_cast<double>(k % columns),
                 y = row * static_cast<double>(rows - 1 - k / columns) + footer;
    draw_kind(script, {x, y + ratios, column - gap, values - gap / 2},
              {x, y, column - gap, ratios - gap / 2}, kinds[k], k, limit);
  }
  script.line("unset multiplot");
  return figure_of(script);
}

}  // namespace skyfit::plot
