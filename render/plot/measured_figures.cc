// SPDX-License-Identifier: Apache-2.0
#include "render/plot/measured_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace skyfit::plot {
namespace {

bool has_irradiances(const MeasuredOutcome& outcome) { return !outcome.irradiances.empty(); }
bool has_directions(const MeasuredOutcome& outcome) { return !outcome.samples.empty(); }

using Outcomes = std::span<const MeasuredOutcome>;

constexpr std::array<MeasuredFigure, 6> kFigures = {{
    {"maps", "measured, model and their ratio over the sky, a row per scan (at most 6)", false,
     has_directions,
     [](Outcomes fits, int, const Sheet& sheet) { return maps_figure(fits[0], sheet); }},
    {"spectra", "up to six directions of one spectral scan with what a sample scatters by", false,
     [](const MeasuredOutcome& outcome) { return outcome.spectral; },
     [](Outcomes fits, int scan, const Sheet& sheet) {
       return spectra_figure(fits[0], scan, sheet);
     }},
    {"residuals", "model / measured - 1 against scattering angle, view zenith and wavelength",
     false, has_directions,
     [](Outcomes fits, int, const Sheet& sheet) { return residuals_figure(fits[0], sheet); }},
    {"irradiances", "irradiances against the sun's zenith angle", false, has_irradiances,
     [](Outcomes fits, int, const Sheet& sheet) { return irradiances_figure(fits[0], sheet); }},
    {"corner", "the covariance: densities, and pairs with ellipses of 1 and 2 sigma", false,
     [](const MeasuredOutcome& outcome) { return outcome.covariance.size() >= 2; },
     [](Outcomes fits, int, const Sheet& sheet) { return corner_figure(fits[0], sheet); }},
    {"series", "unknowns over the time of their scans with one sigma", true, has_series,
     [](Outcomes fits, int, const Sheet& sheet) { return series_figure(fits, sheet); }},
}};

}  // namespace

std::span<const MeasuredFigure> measured_figures() { return kFigures; }

const MeasuredFigure& measured_figure(std::string_view name) {
  for (const MeasuredFigure& figure : kFigures) {
    if (figure.name == name) return figure;
  }
  std::vector<std::string_view> names;
  for (const MeasuredFigure& figure : kFigures) names.push_back(figure.name);
  throw std::invalid_argument(
      fmt::format("figure \"{}\": expected one of {}", name, fmt::join(names, ", ")));
}

Figure draw(const MeasuredFigure& figure, std::span<const MeasuredOutcome> fits, int scan,
            const Sheet& sheet) {
  if (fits.size() != 1 && !figure.takes_several)
    throw std::invalid_argument(
        fmt::format("figure: {} fits of measured skies: expected 1 for this figure", fits.size()));
  const bool of_directions = figure.can_draw == has_directions;
  if (of_directions && !std::ranges::all_of(fits, has_directions)) {
    throw std::invalid_argument(fmt::format(
        "figure {}: irradiances have no directions: expected the figure irradiances", figure.name));
  }
  return figure.draw(fits, scan, sheet);
}

std::string short_name(const std::string& name) { return name.substr(name.rfind('/') + 1); }

std::string scan_label(const MeasuredOutcome& outcome, int scan) {
  const MeasuredScan& info = outcome.scans.at(static_cast<std::size_t>(scan - 1));
  return info.name.empty() ? fmt::format("scan {}", scan) : short_name(info.name);
}

int wavelength_step(const MeasuredOutcome& outcome, double width_px) {
  constexpr double kNumber_px = 36;
  const auto [first, last] =
      std::ranges::minmax_element(outcome.samples, {}, &Sample::wavelength_nm);
  const double span = last->wavelength_nm - first->wavelength_nm;
  for (const int step : {100, 200, 500})
    if (span / step * kNumber_px <= width_px) return step;
  return 1000;
}

std::string wavelength_range(const MeasuredOutcome& outcome) {
  constexpr double kMargin_nm = 50;
  const auto [first, last] =
      std::ranges::minmax_element(outcome.samples, {}, &Sample::wavelength_nm);
  if (first->wavelength_nm < last->wavelength_nm) return "set xrange [*:*] noextend";
  return fmt::format("set xrange [{:.6g}:{:.6g}]", first->wavelength_nm - kMargin_nm,
                     first->wavelength_nm + kMargin_nm);
}

}  // namespace skyfit::plot
