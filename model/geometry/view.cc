// SPDX-License-Identifier: Apache-2.0
#include "model/geometry/view.h"

#include <algorithm>
#include <cmath>

namespace skyfit {

View view_of(double bottom, double top, const SkyPoint& point) {
  const double mu = std::cos(point.view_zenith), mu_s = std::cos(point.sun_zenith);
  const double nu =
      std::clamp(mu * mu_s + std::sin(point.view_zenith) * std::sin(point.sun_zenith) *
                                 std::cos(point.relative_azimuth),
                 -1.0, 1.0);
  const ViewRay ray = view_ray(bottom, top, point.altitude_m, mu);
  const double entry_mu_s =
      ((bottom + point.altitude_m) * mu_s + ray.entry_distance * nu) / (bottom + ray.entry_height);
  return {ray, std::clamp(entry_mu_s, -1.0, 1.0), nu};
}

}  // namespace skyfit
