// SPDX-License-Identifier: Apache-2.0
#include "render/plot/measured_figures.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <stdexcept>

namespace skyfit::plot {
namespace {

constexpr std::array<std::pair<std::string_view, MeasuredFigure>, 5> kFigures = {
    {{"maps", MeasuredFigure::kMaps},
     {"spectra", MeasuredFigure::kSpectra},
     {"residuals", MeasuredFigure::kResiduals},
     {"corner", MeasuredFigure::kCorner},
     {"series", MeasuredFigure::kSeries}}};

}  // namespace

std::vector<std::string_view> measured_figure_names() {
  std::vector<std::string_view> names;
  for (const auto& [name, figure] : kFigures) names.push_back(name);
  return names;
}

MeasuredFigure measured_figure_from_name(std::string_view name) {
  for (const auto& [known, figure] : kFigures) {
    if (known == name) return figure;
  }
  throw std::invalid_argument(fmt::format("figure \"{}\": expected one of {}", name,
                                          fmt::join(measured_figure_names(), ", ")));
}

bool can_draw(MeasuredFigure figure, const MeasuredOutcome& outcome) {
  switch (figure) {
    case MeasuredFigure::kSpectra:
      return outcome.spectral;
    case MeasuredFigure::kCorner:
      return outcome.covariance.size() >= 2;
    case MeasuredFigure::kSeries:
      return outcome.scans.size() >= 2 &&
             std::ranges::any_of(outcome.unknowns,
                                 [](const MeasuredUnknown& u) { return u.scan > 0; }) &&
             std::ranges::none_of(outcome.scans,
                                  [](const MeasuredScan& s) { return s.time_utc.empty(); });
    case MeasuredFigure::kMaps:
    case MeasuredFigure::kResiduals:
      break;
  }
  return true;
}

Figure measured_figure(MeasuredFigure figure, std::span<const MeasuredOutcome> fits, int scan) {
  if (fits.size() != 1 && figure != MeasuredFigure::kSeries)
    throw std::invalid_argument(
        fmt::format("figure: {} fits of measured skies: expected 1 for this figure", fits.size()));
  switch (figure) {
    case MeasuredFigure::kMaps:
      return maps_figure(fits[0]);
    case MeasuredFigure::kSpectra:
      return spectra_figure(fits[0], scan);
    case MeasuredFigure::kResiduals:
      return residuals_figure(fits[0]);
    case MeasuredFigure::kCorner:
      return corner_figure(fits[0]);
    case MeasuredFigure::kSeries:
      break;
  }
  return series_figure(fits);
}

std::string short_name(const std::string& name) { return name.substr(name.rfind('/') + 1); }

std::string scan_label(const MeasuredOutcome& outcome, int scan) {
  const MeasuredScan& info = outcome.scans.at(static_cast<std::size_t>(scan - 1));
  return info.name.empty() ? fmt::format("scan {}", scan) : short_name(info.name);
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
