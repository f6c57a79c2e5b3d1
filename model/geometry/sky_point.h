// SPDX-License-Identifier: Apache-2.0
// A line of sight and the sun.
#pragma once

namespace skyfit {

// One line of sight. Angles in radians. The observer stands `altitude_m` above the bottom radius;
// zenith angles are those at the observer. Azimuth 0 looks toward the sun's azimuth. view_zenith >
// pi/2 looks down.
struct SkyPoint {
  double altitude_m = 0;
  double sun_zenith = 0;
  double view_zenith = 0;
  double relative_azimuth = 0;
};

}  // namespace skyfit
