// SPDX-License-Identifier: Apache-2.0
// Irradiances against the sun's zenith angle, and below what the model is off.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/irradiance.h"
#include "render/plot/legend.h"
#include "render/plot/measured_figures.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kHeader = 92, kFooter = 62, kColumn = 330, kValues = 260, kRatios = 170,
                 kLeft = 92, kGap = 62;

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
    if (std::ranges::count(outcome.samples, name, &Sample::irradiance) > 0) kinds.push_back(name);
  }
  return kinds;
}

// Sun zenith angle, measured, sigma, model, percent, sigma in percent; by sun.
void write_samples(Script& script, const MeasuredOutcome& outcome, std::string_view kind,
                   std::size_t index) {
  std::vector<Sample> samples;
  for (const Sample& s : outcome.samples) {
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
  for (const Sample& s : outcome.samples) {
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
      "set xtics 15 nomirror textcolor rgb '#202020' format '{}'; set ytics nomirror textcolor rgb "
      "'#202020'",
      with_suns ? "%g" : "");
}

}  // namespace

Figure irradiances_figure(const MeasuredOutcome& outcome) {
  const std::vector<std::string_view> kinds = kinds_of(outcome);
  if (kinds.empty())
    throw std::invalid_argument("figure irradiances: expected a fit of irradiances");
  const double width = kLeft + kColumn * std::max(2.0, static_cast<double>(kinds.size())),
               height = kHeader + kValues + kRatios + kFooter;
  const double limit = limit_percent(outcome);
  Script script(width, height);
  script.line("set multiplot");
  for (std::size_t k = 0; k < kinds.size(); ++k) write_samples(script, outcome, kinds[k], k);
  script.begin_axes({0, 0, width, height});
  script.text_label(16, height - 24, "Irradiances, " + short_name(outcome.title),
                    "left font ',18'");
  script.text_label(16, kFooter + kRatios + kValues / 2, outcome.irradiance_unit,
                    "center rotate by 90 font ',13'");
  script.text_label(16, kFooter + kRatios / 2 - kGap / 4, "model / measured − 1, %",
                    "center rotate by 90 font ',13'");
  script.text_label(width / 2, 18, "sun zenith, °", "center font ',13'");
  draw_legend(script,
              {{Mark::kPoint, kReferenceColor, "measured, one sigma"},
               {Mark::kHollowPoint, kCurveColors[0], "fitted"}},
              width / 2, height - 54);
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const double left = kLeft + kColumn * static_cast<double>(k);
    begin_panel(script, {left, kFooter + kRatios, kColumn - kGap, kValues - kGap / 2}, false);
    script.text_label(left + 6, kFooter + kRatios + kValues - kGap / 4, words_of(kinds[k]),
                      "left font ',12'");
    script.line("set yrange [0:*]");
    script.line(
        "plot $kind{0} using 1:2:3 with yerrorbars pt 7 ps 0.7 lw 1.4 lc rgb '{1}' notitle, "
        "$kind{0} "
        "using 1:4 with points pt 6 ps 1.3 lw 1.8 lc rgb '{2}' notitle",
        k, kReferenceColor, kCurveColors[0]);
    begin_panel(script, {left, kFooter, kColumn - kGap, kRatios - kGap / 2}, true);
    script.line("set yrange [{:.6g}:{:.6g}]", -limit, limit);
    script.line(
        "plot 0 lc rgb '#404040' lw 1 notitle, $kind{0} using 1:5:6 with yerrorbars pt 6 ps 1.3 lw "
        "1.4 lc rgb '{1}' notitle",
        k, kCurveColors[0]);
  }
  script.line("unset multiplot");
  return {width, height, script.text()};
}

}  // namespace skyfit::plot
