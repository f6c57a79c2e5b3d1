// SPDX-License-Identifier: Apache-2.0
// Light of another spectrum than the star's. Tables and models hold values per unit irradiance at
// the nodes of a rule; under another spectrum these values stay and their weights change. Weights
// here are those of a light whose illuminance above the air is the star's.
#pragma once

#include "model/photometry/photometry.h"

namespace skyfit {

// In lx above the air, at normal incidence.
double illuminance_of(const SpectralData& spectra);

// Under another star, whose `spectra` are those of under(). The nodes stay, and with them the cross
// sections of oxygen pairs and nitrogen dioxide, which are means under the first star. Throws
// std::invalid_argument where that star's illuminance is 0.
ColorRule color_rule_under(const SpectralData& spectra, const ColorRule& star);
LuminanceRule luminance_rule_under(const SpectralData& spectra, const LuminanceRule& star);

// Of the star's light that the moon reflects. Approximate: one colour for all phases.
ColorRule moonlight_color_rule(const ColorRule& star);
LuminanceRule moonlight_luminance_rule(const LuminanceRule& star);

// The moon's disc-equivalent reflectance at a phase angle of 30 deg, the mean of waxing and waning
// (Kieffer & Stone 2005, Astron. J. 129, 2887, eq. 10 and table 4, of which the polynomial in the
// phase angle alone), linear between the bands; 350 to 865.3 nm. Throws std::out_of_range outside.
double moon_reflectance(double wavelength_nm);

inline constexpr double kMoonRadius_m = 1737.4e3, kMoonDistance_m = 384.4e6;  // the mean distance

// Illuminance of the Earth's moon, at its mean distance, over the sun's, by the phase angle from 0
// to pi (sun, moon, eye): V = -12.73 + 0.026 |a| + 4e-9 a^4, a in degrees (Krisciunas & Schaefer
// 1991, PASP 103, 1033, eq. 9, after Allen), and of the sun -26.76 (Willmer 2018, ApJS 236, 47).
// The Earth's shadow is not in it.
double moon_illuminance_share(double phase);

}  // namespace skyfit
