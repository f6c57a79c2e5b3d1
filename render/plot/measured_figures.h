// SPDX-License-Identifier: Apache-2.0
// The figures of fits of measured skies.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "render/plot/figure_file.h"
#include "render/plot/measured_result.h"

namespace skyfit::plot {

struct MeasuredFigure {
  std::string_view name, meaning;
  bool takes_several;  // fits
  // Whether the fit has what the figure shows.
  bool (*can_draw)(const MeasuredOutcome& outcome);
  // `scan` (from 1) is that of spectra.
  Figure (*draw)(std::span<const MeasuredOutcome> fits, int scan, const Sheet& sheet);
};

// Every figure; help texts, `skyfit fit` and `skyfit plot --figure` follow it.
std::span<const MeasuredFigure> measured_figures();
// Throws std::invalid_argument that lists the names.
const MeasuredFigure& measured_figure(std::string_view name);

// Throws std::invalid_argument with one line for a figure that cannot be drawn of these fits.
Figure draw(const MeasuredFigure& figure, std::span<const MeasuredOutcome> fits, int scan = 1,
            const Sheet& sheet = {});

// The single figures. Their panels are scans in maps, directions in spectra, kinds in irradiances,
// unknowns in corner and series.
Figure maps_figure(const MeasuredOutcome& outcome, const Sheet& sheet = {});
Figure spectra_figure(const MeasuredOutcome& outcome, int scan, const Sheet& sheet = {});
Figure residuals_figure(const MeasuredOutcome& outcome, const Sheet& sheet = {});
Figure irradiances_figure(const MeasuredOutcome& outcome, const Sheet& sheet = {});
Figure corner_figure(const MeasuredOutcome& outcome, const Sheet& sheet = {});
Figure series_figure(std::span<const MeasuredOutcome> fits, const Sheet& sheet = {});
// Whether the scans of a fit have times and two of them an unknown of the same name.
bool has_series(const MeasuredOutcome& fit);

// The last part of a path.
std::string short_name(const std::string& name);
// gnuplot's range of the wavelengths; of a single one it would be empty.
std::string wavelength_range(const MeasuredOutcome& outcome);
// Between the numbers of an axis of wavelengths that is `width_px` wide, nm.
int wavelength_step(const MeasuredOutcome& outcome, double width_px);
std::string scan_label(const MeasuredOutcome& outcome, int scan);

}  // namespace skyfit::plot
