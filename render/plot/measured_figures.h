// SPDX-License-Identifier: Apache-2.0
// The figures of fits of measured skies.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "render/plot/figure_file.h"
#include "render/plot/measured_result.h"

namespace skyfit::plot {

enum class MeasuredFigure {
  kMaps,       // measured, model and their ratio over the sky, a row per scan (at most 6)
  kSpectra,    // six directions of one scan with what a sample scatters by; spectral scans only
  kResiduals,  // model / measured - 1 against scattering angle, view zenith and wavelength
  kCorner,     // the covariance: densities and pairs of 1 and 2 sigma ellipses
  kSeries      // unknowns over the time of their scans, one sigma; several fits may be given
};

// "maps", "spectra", "residuals", "corner", "series"
std::vector<std::string_view> measured_figure_names();
// Throws std::invalid_argument that lists the names.
MeasuredFigure measured_figure_from_name(std::string_view name);

// Whether the fit has what the figure shows.
bool can_draw(MeasuredFigure figure, const MeasuredOutcome& outcome);

// Throws std::invalid_argument with one line for a figure that cannot be drawn. Only kSeries takes
// more than one fit. `scan` (from 1) is that of kSpectra.
Figure measured_figure(MeasuredFigure figure, std::span<const MeasuredOutcome> fits, int scan = 1);

// The single figures.
Figure maps_figure(const MeasuredOutcome& outcome);
Figure spectra_figure(const MeasuredOutcome& outcome, int scan);
Figure residuals_figure(const MeasuredOutcome& outcome);
Figure corner_figure(const MeasuredOutcome& outcome);
Figure series_figure(std::span<const MeasuredOutcome> fits);

// The last part of a path.
std::string short_name(const std::string& name);
// gnuplot's range of the wavelengths; of a single one it would be empty.
std::string wavelength_range(const MeasuredOutcome& outcome);
std::string scan_label(const MeasuredOutcome& outcome, int scan);

}  // namespace skyfit::plot
