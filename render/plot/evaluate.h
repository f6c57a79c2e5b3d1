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

// `model` and `start_model` in the reference's unit, one value per sample, with the scale of the
// sample's scan; `start_model` may be empty. Samples within `exclude_sun` (radians) of the sun get
// weight 0; those without a model (NaN) or a positive value are left out. Throws
// std::invalid_argument when a list has not one entry per sample.
std::vector<Sample> compared_samples(const refs::Reference& reference,
                                     std::span<const double> model,
                                     std::span<const double> start_model, double exclude_sun);

// The same with the atmosphere's luminance by the model. Every scan's scale is the one that leaves
// no mean residual.
std::vector<Sample> evaluated_samples(const refs::Reference& reference,
                                      const Atmosphere<double>& atmosphere,
                                      const SpectralData& spectra, const SkyModel& model,
                                      double exclude_sun);

}  // namespace skyfit::plot
