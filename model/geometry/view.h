// SPDX-License-Identifier: Apache-2.0
// A line of sight inside the atmosphere with the sun. Lengths in metres.
#pragma once

#include "model/geometry/ray.h"
#include "model/geometry/sky_point.h"

namespace skyfit {

// Where the ray of a line of sight runs, and the sun at its beginning inside the atmosphere.
// Cosines.
struct View {
  ViewRay ray;
  double mu_s = 0;  // of the sun's zenith angle where the ray begins
  double nu = 0;    // of the angle between ray and sun
};
View view_of(double bottom_radius, double top, const SkyPoint& point);

}  // namespace skyfit
