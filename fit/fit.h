// SPDX-License-Identifier: Apache-2.0
// Fits an atmosphere to reference skies: maximum a posteriori with Ceres, exact derivatives, the
// model prepared once per step. One fit for CIE skies and measured ones: what differs is the
// likelihood (likelihood.h) and its defaults (options.h).
//
// The starts are solved with few wavelengths; from the best one the fit is refined. Unless the
// noise is known, sigma is multiplied with a factor that the residuals show (noise.h) and the fit
// repeated until the two agree, so that priors weigh what they say. Around the sun that is left out
// is where the instrument truly points.
#pragma once

#include "fit/problem/options.h"
#include "fit/result/result.h"
#include "model/sky_model.h"

namespace skyfit::fit {

// Throws std::invalid_argument for options, a start outside the bounds, or a reference that cannot
// be fitted; std::runtime_error when the solver fails. One line, naming option, value, constraint.
Result fit_atmosphere(const refs::Reference& reference, const SpectralData& spectra,
                      const SkyModel& model, const FitOptions& options);

}  // namespace skyfit::fit
