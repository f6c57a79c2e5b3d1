// SPDX-License-Identifier: Apache-2.0
// Whether the global horizontal light is that of the beam on the horizontal and of the sky.
#pragma once

#include "model/numerics/angles.h"

namespace skyfit::refs {

// Global over the sum of the two, all in one unit; 1 under the right sun, of levelled instruments.
inline double closure(double global, double direct_horizontal, double diffuse) {
  return global / (direct_horizontal + diffuse);
}

// Where a sun higher than this, zenith angle in radians, leaves more than this to 1, it is another
// sun: nearly four times what the Baseline Surface Radiation Network asks of instruments (8 %).
inline constexpr double kHighSun = 75 * kRadiansPerDegree, kAnotherSun = 0.3;

}  // namespace skyfit::refs
