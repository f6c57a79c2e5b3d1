// SPDX-License-Identifier: Apache-2.0
// Where the sun stands, from time and place: the Earth's orbit by VSOP87 as shortened by Meeus
// (earth_orbit_vsop87.csv), the leading terms of the nutation, aberration, and the parallax of an
// observer on the ellipsoid, in the steps of Reda & Andreas 2004 (Solar Energy 76, 577). Within
// 0.0005 deg of their worked example; better than 0.01 deg for the years 1900 to 2100. Without
// refraction, as the model's rays are straight: near the horizon the sun is seen up to 0.5 deg
// higher.
#pragma once

#include "data_refs/civil_time.h"

namespace skyfit::refs {

// Radians, north and east positive; metres above the ellipsoid.
struct Site {
  double latitude = 0, longitude = 0;
  double elevation_m = 0;
};

struct SolarPosition {
  double zenith = 0;       // radians, topocentric, not refracted
  double azimuth = 0;      // radians clockwise from north, 0 <= . < 2 pi
  double distance_au = 1;  // of the Earth's centre
};

SolarPosition solar_position(Instant time, const Site& site);

// How much higher than it is a sun at this zenith angle is seen at sea level, radians (Saemundsson
// 1986, as in Meeus 1998, eq. 16.4: 1010 hPa, 10 deg C); 0 where it is below the horizon by 1 deg.
double refraction(double zenith);

// Astronomical units; needs no place.
double sun_distance_au(Instant time);

}  // namespace skyfit::refs
