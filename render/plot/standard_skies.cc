// SPDX-License-Identifier: Apache-2.0
#include "render/plot/standard_skies.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "model/base/misfit.h"
#include "render/plot/script.h"

namespace skyfit::plot {
namespace {

constexpr double kLeft = 560, kHeader = 96, kFooter = 34, kRow = 30, kCell = 58, kMargin = 16,
                 kGap = 10, kDescription = 541;
// Percent: the brightest colour; what is worse looks the same and says its number.
constexpr double kBrightest = 32;

void draw_cell(Script& script, double left, double bottom, double percent) {
  const double share = std::sqrt(std::clamp(percent / kBrightest, 0.0, 1.0));
  script.line("set object rectangle from {} to {} fc rgb '{}' fs solid noborder",
              script.at(left + 1, bottom + 1), script.at(left + kCell - 1, bottom + kRow - 1),
              sequential_color(share));
  script.text_label(
      left + kCell / 2, bottom + kRow / 2,
      is_factor(percent) ? log_misfit(percent, 1) : fmt::format("{:.3g}", percent),
      fmt::format("center font text_font textcolor rgb '{}'", share > 0.6 ? "#000000" : "#ffffff"));
}

}  // namespace

Figure standard_skies_figure(const std::vector<double>& sun_zenith_deg,
                             const std::vector<StandardSkyRow>& rows) {
  for (const StandardSkyRow& row : rows) {
    if (row.rms_percent_of_sun.size() == sun_zenith_deg.size()) continue;
    throw std::invalid_argument(
        fmt::format("figure of standard skies: type {} has {} suns, expected {}", row.type,
                    row.rms_percent_of_sun.size(), sun_zenith_deg.size()));
  }
  const double suns_left = kLeft + kCell + kGap;
  const double width = suns_left + kCell * static_cast<double>(sun_zenith_deg.size()) + kMargin;
  const double height = kHeader + kRow * static_cast<double>(rows.size()) + kFooter;
  Script script(width, height, {});
  script.line("set multiplot");
  script.begin_axes({0, 0, width, height});
  script.line("unset border; unset tics");
  script.text_label(kMargin, height - 26, "Standard skies as horizontally uniform atmospheres",
                    "left font title_font");
  script.text_label(
      kMargin, height - 50,
      "RMS of log(model / CIE) in percent, above 50 % as a factor; one joint fit per type",
      "left font text_font textcolor rgb '#404040'");
  const double head = height - kHeader + 12;
  script.text_label(kLeft + kCell / 2, head, "joint", "center font text_font");
  for (std::size_t s = 0; s < sun_zenith_deg.size(); ++s)
    script.text_label(suns_left + kCell * (static_cast<double>(s) + 0.5), head,
                      fmt::format("{:.4g}", sun_zenith_deg[s]), "center font text_font");
  script.text_label(suns_left + kCell * static_cast<double>(sun_zenith_deg.size()) / 2, head + 20,
                    "sun zenith angle, deg", "center font text_font");
  double bottom = height - kHeader;
  for (const StandardSkyRow& row : rows) {
    bottom -= kRow;
    script.text_label(kMargin + 22, bottom + kRow / 2 + 5, fmt::format("{}", row.type),
                      "right font text_font");
    script.text_label(kMargin + 32, bottom + kRow / 2 + 6,
                      shortened(row.description, kDescription, script.sheet()),
                      "left font note_font");
    script.text_label(kMargin + 32, bottom + kRow / 2 - 7, row.fitted_with,
                      "left font small_font textcolor rgb '#606060'");
    draw_cell(script, kLeft, bottom, row.rms_percent);
    for (std::size_t s = 0; s < row.rms_percent_of_sun.size(); ++s)
      draw_cell(script, suns_left + kCell * static_cast<double>(s), bottom,
                row.rms_percent_of_sun[s]);
  }
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
  script.line("unset multiplot");
  return figure_of(script);
}

}  // namespace skyfit::plot
