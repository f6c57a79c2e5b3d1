// SPDX-License-Identifier: Apache-2.0
#include "model/geometry/sun_disc.h"

#include <algorithm>
#include <cmath>

#include "model/shared/shared.h"

namespace skyfit {

double deep_twilight(double sun, double lowest) {
  return std::exp(std::min((sun - lowest) * 57.3, 0.0));
}

double horizon_cosine(double bottom, double height) {
  return -Shared<double>{}.horizon_distance(height, bottom) / (bottom + height);
}

double visible_sun(double bottom, double height, double mu_s, double angular_radius) {
  const double half_disc = bottom / (bottom + height) * angular_radius;
  const double above = mu_s - horizon_cosine(bottom, height);
  const double t = std::clamp(above / (2 * half_disc) + 0.5, 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

}  // namespace skyfit
