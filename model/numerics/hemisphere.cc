// SPDX-License-Identifier: Apache-2.0
#include "model/numerics/hemisphere.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/numerics/gauss.h"

namespace skyfit {

std::vector<SkySample> sky_samples(double mu_s, int polar, int azimuth) {
  const GaussRule about = gauss_legendre(polar), around = gauss_legendre(azimuth);
  const double sun_sine = std::sqrt(std::max(1 - mu_s * mu_s, 0.0));
  std::vector<SkySample> samples;
  for (int i = 0; i < polar; ++i) {
    const double x = about.node[i], theta = std::numbers::pi * x * x;
    const double c = std::cos(theta), s = std::sin(theta);
    // mu = c mu_s + s sun_sine cos(a): above the horizon where cos(a) > -c mu_s / (s sun_sine)
    const double limit = s * sun_sine > 1e-12 ? -c * mu_s / (s * sun_sine)
                         : c * mu_s > 0       ? -1.0
                                              : 1.0;
    const double arc = std::acos(std::clamp(limit, -1.0, 1.0));
    for (int k = 0; arc > 0 && k < azimuth; ++k) {
      const double mu =
          std::clamp(c * mu_s + s * sun_sine * std::cos(arc * around.node[k]), 0.0, 1.0);
      samples.push_back(
          {mu, c, 4 * std::numbers::pi * arc * around.weight[k] * about.weight[i] * x * s * mu});
    }
  }
  return samples;
}

}  // namespace skyfit
