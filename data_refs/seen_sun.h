// SPDX-License-Identifier: Apache-2.0
// Where the light of a sky itself puts the sun: a check of clocks, places and azimuths that needs
// no model of the atmosphere.
#pragma once

#include <optional>
#include <span>

#include "data_refs/samples.h"

namespace skyfit::refs {

// Angles in radians; azimuths as in Sample, from the sun that the samples state.
struct SeenSun {
  double zenith = 0, relative_azimuth = 0;
  double sigma = 0;          // one standard deviation of the direction, of the misfit's curvature
  double misfit = 0;         // root mean square of ln of the sky, with the sun that is seen,
  double stated_misfit = 0;  // and with the stated one
  double brightest = 0;      // angle from the stated sun to the brightest direction
};

// Of the samples of one scan: ln of the sky as a sum of a function of the view's zenith angle and
// one of the angle to the sun (the form of Perez, Seals & Michalsky 1993 and of CIE S 011), by
// least squares, with the sun at which that is best; directions darker
// than a quarter of their ring are not used. Nothing where the samples do not surround the
// sky: fewer than 24 directions, a gap of more than 100 deg in azimuth, less than 30 deg of zenith
// angles, or a sun that moves.
std::optional<SeenSun> seen_sun(std::span<const Sample> scan);

// Angle from the stated sun to the one that is seen.
double seen_from_stated(const SeenSun& seen, double stated_zenith);

}  // namespace skyfit::refs
