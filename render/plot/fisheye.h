// SPDX-License-Identifier: Apache-2.0
// Skies as fisheye pictures, a row per model and a column per sun, all at one exposure.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "model/photometry/photometry.h"
#include "model/sky_model.h"
#include "render/plot/figure_file.h"

namespace skyfit::plot {

// Linear sRGB (cd/m^2) on a grid of view zeniths 0 .. 90 deg and azimuths 0 .. 180 deg from the
// sun's, row major.
struct FisheyeSky {
  static constexpr int kZeniths = 46, kAzimuths = 37;
  std::vector<std::array<double, 3>> rgb;
};
// Throws what the model throws.
FisheyeSky fisheye_sky(const SkyModel& model, const Atmosphere<double>& atmosphere,
                       const SpectralData& spectra, double sun_zenith);

struct FisheyeRow {
  std::string label;
  std::vector<std::optional<FisheyeSky>> skies;  // per sun; empty: the model cannot
};
struct FisheyeFigure {
  std::string title;
  std::vector<double> sun_zenith_deg;
  std::vector<FisheyeRow> rows;  // the first one sets the exposure
};
// The panels are the suns. Throws std::invalid_argument for a figure without a sky, and what
// Sheet::chosen() throws.
Figure fisheye_figure(const FisheyeFigure& figure, const Sheet& sheet = {});

}  // namespace skyfit::plot
