// SPDX-License-Identifier: Apache-2.0
// The comparison figure of one or several fits, from what a fit leaves: preset.json and
// samples.csv.
#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "model/atmosphere/preset.h"
#include "model/photometry/photometry.h"
#include "model/sky_model.h"
#include "render/plot/comparison.h"

namespace skyfit::plot {

struct FitOutcome {
  std::string folder;  // name that messages and, among presets of one name, the legend show
  Preset preset;       // with the `fit` member that the fit wrote
  std::vector<Sample> samples;
};

// Reads preset.json and samples.csv of a result directory. Throws std::runtime_error or
// std::invalid_argument with one line that names the file, and the line or the field.
FitOutcome read_fit_outcome(const std::filesystem::path& directory);

// The sky model of a name and transfer, of make_sky_model().
using ModelNamed = std::function<const SkyModel&(std::string_view name, Transfer transfer)>;

// One curve per fit. The panels show the fits' own samples. The maps show the 145 Tregenza patches,
// on which an analytic reference and the preset are evaluated with the model of the fit; for a
// measured reference they show the samples. Throws std::invalid_argument with one line when the
// fits cannot share a figure: different units, none, more than kMapCurves.
Comparison comparison_of(std::span<const FitOutcome> fits, const SpectralData& spectra,
                         const ModelNamed& model_named);

}  // namespace skyfit::plot
