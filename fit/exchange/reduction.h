// SPDX-License-Identifier: Apache-2.0
// A preset's sky by an atmosphere of a simpler form, refitted, and what is lost.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fit/exchange/engine_form.h"
#include "model/sky_model.h"

namespace skyfit::fit {

// What the preset is, and what the program can do: nature's light is polarised, that of engines is
// not.
struct Models {
  const SkyModel& truth;
  const SkyModel& engine;
};

// How two skies differ: suns 10 to 85 deg from the zenith, the 145 patches of Tregenza, without
// those within 3 deg of the sun.
struct SkyLoss {
  double rms_percent = 0;            // of ln of the luminances
  double worst_percent = 0;          // 100 ln, of the largest
  SkyPoint worst;                    // where it is
  double mean_uv = 0, worst_uv = 0;  // distance in CIE 1976 u', v'
};

SkyLoss sky_loss(const Models& models, const SpectralData& spectra, const Atmosphere<double>& truth,
                 const Atmosphere<double>& approximate);

// "RMS 1.2 % of luminance (worst 4.1 % at sun 85, view 84, azimuth 12 deg), ..".
std::string loss_text(const SkyLoss& loss);

// `start` with these parameters, as far as they lie within their bounds, refitted to the sky of
// `truth` at 680, 550 and 440 nm, all suns jointly, in logarithms without priors. Without a fit
// where the two skies already agree within 0.01 %. Throws std::runtime_error where the fit fails.
Atmosphere<double> refitted(const Models& models, const SpectralData& spectra,
                            const Atmosphere<double>& truth, const Atmosphere<double>& start,
                            const std::vector<Parameter>& free,
                            const std::function<void(double)>& progress);

}  // namespace skyfit::fit
