// SPDX-License-Identifier: Apache-2.0
// How far a luminance is from a reference: root mean square of log(model/reference), the scale of
// every scan profiled out, weighted with the samples' weights (not with their sigma).
#pragma once

#include <vector>

#include "fit/fit.h"
#include "fit/problem/residuals.h"

namespace skyfit::fit {

// `luminance` holds all samples of the reference.
RmsSummary rms_summary(const refs::Reference& reference, const Luminance& luminance,
                       double exclude_sun);

// One entry per scan, in the order of their first samples.
std::vector<RmsOfSun> rms_per_sun(const refs::Reference& reference, const Luminance& luminance,
                                  double exclude_sun);

}  // namespace skyfit::fit
