// SPDX-License-Identifier: Apache-2.0
#include "render/plot/comparison.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "render/plot/header.h"
#include "render/plot/hemisphere_maps.h"
#include "render/plot/legend.h"
#include "render/plot/plane_panels.h"
#include "render/plot/suns.h"

namespace skyfit::plot {
namespace {

constexpr double kLeft = 84;    // luminance labels
constexpr double kFooter = 72;  // axis title of the panels, colour scale of the maps

constexpr std::string_view kViewTitle =
    "view zenith in the sun's vertical plane (positive: toward the sun)";
constexpr std::string_view kMapsTitle = "whole sky: centre zenith, rim horizon, sun's side right";

struct Layout {
  double width, height;
  Header header;
  double left;  // of the panels
  Grid panels;
  Box maps, scale;
};

Grid panel_grid(std::size_t count, std::size_t columns, const Box& area) {
  return {columns, (count + columns - 1) / columns, area};
}

Layout layout_on_screen(const Suns& suns, const Comparison& comparison, const Sheet& sheet,
                        const std::string& subtitle) {
  const std::size_t count = suns.shown.size(), columns = panel_columns(count);
  const std::size_t rows = (count + columns - 1) / columns;
  const double row_height = rows == 1 ? 420 : rows == 2 ? 340 : 270;
  const bool wide = suns.has_hemisphere || comparison.curves.size() > kMapCurves;
  // The legend of many curves stands centred over the panels, which then fill the width.
  const std::vector<LegendEntry> legend = plane_legend(comparison, suns);
  const double legend_width = kLeft + legend_width_px(legend, sheet) + kLeft;
  const double width = wide ? std::max(1600.0, suns.has_hemisphere ? 0 : legend_width) : 1080;
  const double right = suns.has_hemisphere ? 910 : width - 10;
  const double body = row_height * static_cast<double>(rows);
  Header header(sheet, width, comparison.title, subtitle, legend, right - kLeft);
  const double height = header.height_px() + body + kFooter;
  const Box maps{right + 20, kFooter, width - right - 30, body};
  const double scale = std::min(maps.width * 0.8, 520.0);
  return {width,
          height,
          std::move(header),
          kLeft,
          {columns, rows, {kLeft, kFooter, right - kLeft, body}},
          maps,
          {maps.left + (maps.width - scale) / 2, 52, scale, 14}};
}

// The least width of a panel: its numbers and angles have room. Narrower ones where the figure
// would become very high.
std::size_t columns_on_page(std::size_t count, double width) {
  constexpr double kLeast = 88, kGood = 140;
  constexpr std::size_t kManyRows = 4;
  const auto columns = [&](double least) {
    return std::clamp<std::size_t>(static_cast<std::size_t>(width / least), 1,
                                   panel_columns(count));
  };
  const std::size_t good = columns(kGood);
  return (count + good - 1) / good > kManyRows ? columns(kLeast) : good;
}

std::string cone_note(const Comparison& comparison, bool explains_rms) {
  std::string note = "☉ sun";
  if (comparison.exclude_sun_deg > 0)
    note += fmt::format("; shaded: within {:.3g}° of it, left out", comparison.exclude_sun_deg);
  return note +
         (explains_rms ? "; above a panel: its angle and the RMS of log(model / reference)" : "");
}

// Maps stand below the panels.
Layout layout_on_page(const Suns& suns, const Comparison& comparison, const Sheet& sheet,
                      const std::string& subtitle) {
  constexpr double kTickLabels = 46, kGap = 8, kScaleBar = 10, kMapCell = 140, kLeastMap = 95,
                   kMapTitle = 26, kMostSide = 200;
  const std::size_t count = suns.shown.size(), curves = comparison.curves.size();
  const double width = sheet.width_px(0), line = sheet.line_px();
  const double left = kGap + 2 * line + kTickLabels, room = width - left;
  const std::size_t columns = columns_on_page(count, room);
  const double cell = room / static_cast<double>(columns);
  const double row = std::clamp(0.8 * cell, 120.0, 260.0) + plane_strip_px(sheet, cell, suns);
  Header header(sheet, width, comparison.title, subtitle, plane_legend(comparison, suns));
  const auto lines = [&](std::string_view text, double of_width) {
    return line * static_cast<double>(wrapped(text, of_width, sheet).size());
  };
  double maps = 0, scale = 0, scale_bottom = 0;
  if (suns.has_hemisphere) {
    const double per_row = std::clamp(
        std::max(std::floor(width / kMapCell), std::min(std::floor(width / kLeastMap), 3.0)), 1.0,
        static_cast<double>(count));
    const double side = std::min(width / per_row, kMostSide);
    const double rows = std::ceil(static_cast<double>(count) / per_row);
    maps = static_cast<double>(curves) * (rows * (side + kMapTitle) + (curves > 1 ? kMapTitle : 0));
    scale = 0.8 * width;
    scale_bottom =
        2 * line + lines(residual_scale_title(residual_limit_percent(suns)), width - 2 * kGap);
    maps += lines(kMapsTitle, width) + kGap;
  }
  const double maps_bottom = suns.has_hemisphere ? scale_bottom + kScaleBar + kGap : 0;
  const double panels_bottom = maps_bottom + maps + 2 * kGap + line + lines(kViewTitle, room) +
                               lines(cone_note(comparison, true), room);
  const auto rows = static_cast<double>((count + columns - 1) / columns);
  const Box area{left, panels_bottom, room, rows * row};
  return {width,
          panels_bottom + area.height + header.height_px(),
          std::move(header),
          left,
          panel_grid(count, columns, area),
          {0, maps_bottom, width, maps - lines(kMapsTitle, width) - kGap},
          {(width - scale) / 2, scale_bottom, scale, kScaleBar}};
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

std::string subtitle_of(const Comparison& comparison, const Suns& suns) {
  std::string subtitle = comparison.subtitle;
  if (suns.total > suns.shown.size())
    subtitle += fmt::format("{}{} of {} sun positions shown", subtitle.empty() ? "" : "; ",
                            suns.shown.size(), suns.total);
  return subtitle;
}

void draw_titles(Script& script, const Comparison& comparison, const Suns& suns,
                 const Layout& layout) {
  const Sheet& sheet = script.sheet();
  const Box& panels = layout.panels.area;
  const double middle = panels.left + panels.width / 2;
  script.begin_axes({0, 0, layout.width, layout.height});
  layout.header.draw(script, sheet.on_page() ? layout.width / 2 : middle);
  script.upright_lines(sheet.on_page() ? 12 : 22, panels.bottom + panels.height / 2, panels.height,
                       luminance_title(comparison, suns), "font axis_font");
  const double below_ticks = sheet.on_page() ? 28 : 38;
  const std::size_t lines = script.text_lines(middle, panels.bottom - below_ticks, panels.width,
                                              kViewTitle, "center font axis_font");
  script.text_lines(middle,
                    panels.bottom - below_ticks -
                        (sheet.on_page() ? sheet.line_px() : 18) * static_cast<double>(lines),
                    panels.width, cone_note(comparison, sheet.on_page()),
                    fmt::format("center font note_font textcolor rgb '{}'", kSunColor));
  if (suns.has_hemisphere)
    script.text_lines(
        layout.maps.left + layout.maps.width / 2,
        layout.maps.top() +
            (sheet.on_page()
                 ? sheet.line_px() * static_cast<double>(
                                         wrapped(kMapsTitle, layout.maps.width, sheet).size() - 1) +
                       8
                 : 18),
        layout.maps.width, kMapsTitle, "center font axis_font");
  script.line("set xrange [0:1]; set yrange [0:1]; plot NaN notitle");
}

Suns chosen_suns(const Comparison& comparison, const Sheet& sheet) {
  Suns suns = samples_by_sun(comparison);
  std::vector<std::string> names;
  for (const SunSamples& sun : suns.shown)
    names.push_back(fmt::format("sun zenith {:.4g}°", sun.sun_zenith_deg));
  std::vector<SunSamples> chosen;
  for (const std::size_t place : sheet.chosen(names)) chosen.push_back(suns.shown[place]);
  suns.shown = std::move(chosen);
  return suns;
}

}  // namespace

Figure comparison_figure(const Comparison& comparison, const Sheet& sheet) {
  validate(comparison);
  const Suns suns = chosen_suns(comparison, sheet);
  const std::string subtitle = subtitle_of(comparison, suns);
  const Layout layout = sheet.on_page() ? layout_on_page(suns, comparison, sheet, subtitle)
                                        : layout_on_screen(suns, comparison, sheet, subtitle);
  Script script(layout.width, layout.height, sheet);
  script.line("set multiplot");
  draw_titles(script, comparison, suns, layout);
  draw_plane_panels(script, comparison, suns, layout.panels);
  if (suns.has_hemisphere)
    draw_hemisphere_maps(script, comparison, suns, layout.maps, layout.scale);
  script.line("unset multiplot");
  return figure_of(script);
}

void write_comparison(const Comparison& comparison, const std::vector<std::filesystem::path>& files,
                      const Sheet& sheet) {
  check_figure_files(files);
  write_figure(comparison_figure(comparison, sheet), files);
}

}  // namespace skyfit::plot
