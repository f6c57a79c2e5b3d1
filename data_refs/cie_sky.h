// SPDX-License-Identifier: Apache-2.0
// The CIE standard general sky (CIE S 011/E:2003 = ISO 15469:2004) and the traditional overcast
// sky. Angles in radians. Luminances are relative to the zenith's; a factor per sun position is
// free, because at a high sun the zenith lies in the solar corona. The indicatrix has no meaning
// within about 3 deg of the sun.
#pragma once

#include <span>
#include <string>

namespace skyfit::refs {

// L(Z, chi) / L_zenith = f(chi) phi(Z) / (f(Z_sun) phi(0)), phi(Z) = 1 + a exp(b / cos Z),
// phi(pi/2) = 1, f(chi) = 1 + c (exp(d chi) - exp(d pi/2)) + e cos^2 chi.
struct CieSky {
  int type = 0;  // 1..15
  double a = 0, b = 0, c = 0, d = 0, e = 0;
  std::string description;
};

// Types 1 to 15 in order, from cie_s011_standard_general_sky.csv.
std::span<const CieSky> cie_skies();

// view_zenith in [0, pi/2].
double cie_gradation(const CieSky& sky, double view_zenith);
double cie_indicatrix(const CieSky& sky, double scattering_angle);

// Luminance over that of the zenith; chi is the angle between view and sun.
double cie_relative_luminance(const CieSky& sky, double sun_zenith, double view_zenith,
                              double scattering_angle);

// Moon & Spencer 1942, (1 + 2 cos Z) / 3: the traditional overcast sky, also in S 011.
double traditional_overcast_relative_luminance(double view_zenith);

}  // namespace skyfit::refs
