// SPDX-License-Identifier: Apache-2.0
// The all-weather sky of Perez, Seals & Michalsky 1993 (with the erratum of that year). Angles in
// radians; luminances are relative to the zenith's.
//   l(Z, gamma) = (1 + a exp(b / cos Z)) (1 + c exp(d gamma) + e cos^2 gamma),
// a to e from the sky's clearness epsilon, its brightness Delta and the sun's zenith angle by
// perez_1993.csv, whose header states the formulas.
#pragma once

#include <string_view>

namespace skyfit::refs {

struct PerezSky {
  double epsilon = 1;  // clearness, >= 1: 1 overcast, above 6.2 clear
  double delta = 0.1;  // brightness, > 0, some 0.05 .. 0.6
};

// "perez:EPSILON,DELTA"; throws std::invalid_argument that says what was expected.
bool is_perez_name(std::string_view name);
PerezSky perez_sky_named(std::string_view name);

struct PerezCoefficients {
  double a, b, c, d, e;
};
PerezCoefficients perez_coefficients(const PerezSky& sky, double sun_zenith);

// Over that of the zenith; view_zenith < pi/2.
double perez_relative_luminance(const PerezSky& sky, double sun_zenith, double view_zenith,
                                double scattering_angle);

}  // namespace skyfit::refs
