// SPDX-License-Identifier: Apache-2.0
// Compared samples from a reference and a model: with the values of a fit, or with an atmosphere
// evaluated anew.
#pragma once

#include <span>
#include <vector>

#include "data_refs/samples.h"
#include "model/photometry/photometry.h"
#include "model/sky_model.h"
#include "render/plot/samples_csv.h"

namespace skyfit::plot {

// Luminances (cd/m^2) and the factor of each sample's scan that brings them to the reference; one
// entry per sample.
struct ScaledModel {
  std::span<const double> luminance, scale;
};

// Samples within `exclude_sun` (radians) of the sun get weight 0. Samples of a scan without a scale
// (NaN) are left out. `start` may be empty. Throws std::invalid_argument when a span has not one
// entry per sample.
std::vector<ComparedSample> compared_samples(const refs::Reference& reference,
                                             const ScaledModel& fitted, const ScaledModel& start,
                                             double exclude_sun);

// The same with the atmosphere's luminance by the model. Every scan's scale is the one that leaves
// no mean residual.
std::vector<ComparedSample> evaluated_samples(const refs::Reference& reference,
                                              const Atmosphere<double>& atmosphere,
                                              const SpectralData& spectra, const SkyModel& model,
                                              double exclude_sun);

}  // namespace skyfit::plot
