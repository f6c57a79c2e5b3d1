// SPDX-License-Identifier: Apache-2.0
// Integrals over the sky above a horizontal surface, in polar coordinates about the sun, where the
// aureole is.
#pragma once

#include <vector>

namespace skyfit {

struct SkySample {
  double mu, nu;  // cosines of the view zenith and of the angle to the sun
  double weight;  // solid angle times mu: sum_i weight * radiance = irradiance
};

// Gauss's rules of `polar` x `azimuth` nodes: polar angle pi x^2, azimuth over the arc above the
// horizon.
std::vector<SkySample> sky_samples(double mu_s, int polar, int azimuth);

}  // namespace skyfit
