// SPDX-License-Identifier: Apache-2.0
// Logarithmic residuals of a sky model against observations and their exact Jacobian, the luminance
// scale of every scan profiled out.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "fit/problem/observations.h"
#include "model/photometry/photometry.h"
#include "model/sky_model.h"

namespace skyfit::fit {

// What turns radiances into the quantity of a reference: luminance, or spectral radiance under the
// sun at 1 au of a reference of one wavelength. Throws std::invalid_argument for several. `coarse`:
// a rule for a search, where there is one.
LuminanceRule rule_of(const refs::Reference& reference, const SpectralData& spectra,
                      bool coarse = false);

struct Luminance {
  Eigen::VectorXd value;       // cd/m^2 per point
  Eigen::MatrixXd derivative;  // [point][parameter], per unit of the parameter
};

// Throws what the model throws.
Luminance model_luminance(const SkyModel& model, const LuminanceRule& rule,
                          const Atmosphere<double>& atmosphere, std::span<const SkyPoint> points,
                          std::span<const Parameter> derivatives);

struct LogResiduals {
  // sqrt(weight) / sigma_log (log(model) - log(reference) + log(scale)), sigma_log as observed.
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;   // [sample][parameter], per unit of the parameter
  Eigen::VectorXd log_scale;  // of each scan: log(reference / model)
};

// The rows of the luminance at all samples that belong to the observations.
Luminance select(const Luminance& luminance, const Observations& observations);

// Throws std::domain_error when a luminance is not positive and finite.
LogResiduals log_residuals(const Observations& observations, const Luminance& luminance);

}  // namespace skyfit::fit
