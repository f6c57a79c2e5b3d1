// SPDX-License-Identifier: Apache-2.0
// How far a fit is from what it takes beside radiances, in the units of errors.h.
#pragma once

#include <vector>

#include "fit/problem/sky_values.h"
#include "fit/result/errors.h"

namespace skyfit::fit {

// Of readings of polarisation, by their kind; sigma times the factor.
std::vector<PolarisationErrors> polarisation_errors(const Dataset& readings, const SkyModel& model,
                                                    const SkyState& start, const SkyState& fitted,
                                                    double factor);

// Of the irradiances beside the sky of a dataset, by their kind; models: one value per sample of
// the reference.
std::vector<IrradianceErrors> irradiance_errors(const Dataset& data,
                                                const std::vector<double>& start_model,
                                                const std::vector<double>& model);

}  // namespace skyfit::fit
