// SPDX-License-Identifier: Apache-2.0
// Where an analytic sky is read. Angles in radians; relative azimuth 0 looks toward the sun's
// azimuth.
#pragma once

#include <vector>

#include "data_refs/references.h"

namespace skyfit::refs {

struct SkyDirection {
  double view_zenith;
  double relative_azimuth;
};

// The sun's vertical plane every 5 deg to 85 deg on both sides, from the far side (azimuth pi) over
// the zenith, which comes once, to the sun's side (azimuth 0): 35 directions.
std::vector<SkyDirection> principal_plane_directions();

// Tregenza 1987: rows of patches 12 deg high at altitudes 6, 18, .. 78 deg and one at the zenith;
// 145 in all. The first patch of each row is centred on the sun's azimuth.
struct TregenzaPatch {
  SkyDirection centre;
  double solid_angle_sr;  // all of them: 2 pi
};
std::vector<TregenzaPatch> tregenza_patches();

std::vector<SkyDirection> sampling_directions(Sampling sampling);

}  // namespace skyfit::refs
