// SPDX-License-Identifier: Apache-2.0
#include "render/plot/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/plot/figure_file.h"
#include "render/plot/hemisphere_maps.h"
#include "render/plot/legend.h"
#include "render/plot/plane_panels.h"
#include "render/plot/suns.h"

namespace skyfit::plot {
namespace {

constexpr double kHeader = 96;  // title, subtitle, legend
constexpr double kFooter = 72;  // axis title of the panels, colour scale of the maps
constexpr double kLeft = 84;    // luminance labels

struct Layout {
  double width, height;
  Grid panels;
  Box maps;
};

Layout layout_of(const Suns& suns, const Comparison& comparison) {
  const std::size_t count = suns.shown.size(), columns = panel_columns(count);
  const std::size_t rows = (count + columns - 1) / columns;
  const double row_height = rows == 1 ? 420 : rows == 2 ? 340 : 270;
  const double height = kHeader + row_height * static_cast<double>(rows) + kFooter;
  const bool wide = suns.has_hemisphere || comparison.curves.size() > kMapCurves;
  // The legend of many curves stands centred over the panels, which then fill the width.
  const double legend = kLeft + legend_width_px(plane_legend(comparison, suns)) + kLeft;
  const double width = wide ? std::max(1600.0, suns.has_hemisphere ? 0 : legend) : 1080;
  const double right = suns.has_hemisphere ? 910 : width - 10;
  const double body = height - kHeader - kFooter;
  const Grid panels{columns, rows, {kLeft, kFooter, right - kLeft, body}};
  return {width, height, panels, {right + 20, kFooter, width - right - 30, body}};
}

// True when every sun's zenith sample is 1: the sky divided by its zenith luminance, as the CIE
// writes it.
bool relative_to_zenith(const Suns& suns) {
  for (const auto& sun : suns.shown) {
    const auto zenith = std::ranges::find_if(
        sun.plane[0], [](const Sample& s) { return std::abs(s.view_zenith_deg) < 1e-6; });
    if (zenith == sun.plane[0].end() || std::abs(zenith->reference - 1) > 1e-6) return false;
  }
  return true;
}

std::string luminance_title(const Comparison& comparison, const Suns& suns) {
  if (comparison.quantity == refs::Quantity::kLuminance) return "luminance (cd m⁻²)";
  if (comparison.quantity == refs::Quantity::kSpectralRadiance)
    return "spectral radiance (W m⁻² sr⁻¹ nm⁻¹)";
  return relative_to_zenith(suns) ? "luminance / zenith luminance (relative, no unit)"
                                  : "relative luminance (unit of the reference)";
}

void draw_titles(Script& script, const Comparison& comparison, const Suns& suns,
                 const Layout& layout) {
  const Box& panels = layout.panels.area;
  script.begin_axes({0, 0, layout.width, layout.height});
  script.text_label(16, layout.height - 24, comparison.title, "left font ',18'");
  std::string subtitle = comparison.subtitle;
  if (suns.total > suns.shown.size())
    subtitle += fmt::format("{}{} of {} sun positions shown", subtitle.empty() ? "" : "; ",
                            suns.shown.size(), suns.total);
  script.text_label(16, layout.height - 49, subtitle, "left font ',12' textcolor rgb '#404040'");
  script.text_label(22, panels.bottom + panels.height / 2, luminance_title(comparison, suns),
                    "center rotate by 90 font ',13'");
  script.text_label(panels.left + panels.width / 2, panels.bottom - 38,
                    "view zenith in the sun's vertical plane (positive: toward the sun)",
                    "center font ',13'");
  const std::string cone =
      fmt::format("☉ sun; shaded: within {:.3g}° of it, left out", comparison.exclude_sun_deg);
  script.text_label(panels.left + panels.width / 2, panels.bottom - 56,
                    comparison.exclude_sun_deg > 0 ? cone : "☉ sun",
                    fmt::format("center font ',11' textcolor rgb '{}'", kSunColor));
  draw_legend(script, plane_legend(comparison, suns), panels.left + panels.width / 2,
              panels.top() + 15);
  if (suns.has_hemisphere)
    script.text_label(layout.maps.left + layout.maps.width / 2, layout.maps.top() + 18,
                      "whole sky: centre zenith, rim horizon, sun's side right",
                      "center font ',13'");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
}

std::string figure_body(const Comparison& comparison, const Suns& suns, const Layout& layout) {
  Script script(layout.width, layout.height);
  script.line("set multiplot");
  draw_titles(script, comparison, suns, layout);
  draw_plane_panels(script, comparison, suns, layout.panels);
  if (suns.has_hemisphere) draw_hemisphere_maps(script, comparison, suns, layout.maps, kFooter);
  script.line("unset multiplot");
  return script.text();
}

}  // namespace

void write_comparison(const Comparison& comparison,
                      const std::vector<std::filesystem::path>& files) {
  check_figure_files(files);
  validate(comparison);
  const Suns suns = samples_by_sun(comparison);
  const Layout layout = layout_of(suns, comparison);
  write_figure({layout.width, layout.height, figure_body(comparison, suns, layout)}, files);
}

}  // namespace skyfit::plot
