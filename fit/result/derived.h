// SPDX-License-Identifier: Apache-2.0
// Quantities of the literature that follow from an atmosphere's parameters.
#pragma once

#include "model/atmosphere/atmosphere.h"

namespace skyfit::fit {

// Vertical optical depths at the wavelength of the scattering coefficient, from h = 0 to infinity.
double aerosol_optical_depth(const Atmosphere<double>& atmosphere);   // extinction
double rayleigh_optical_depth(const Atmosphere<double>& atmosphere);  // scattering

// Mean cosine of the scattering angle of the aerosol's phase function. That of Cornette & Shanks
// 1992, eq. 9, is not g: <cos> = g 3 (4 + g^2) / (5 (2 + g^2)).
double aerosol_mean_cosine(const Atmosphere<double>& atmosphere);

// Of the standard atmosphere (ISO 2533) at a height above the sea, metres, below 11 km.
double standard_pressure_hpa(double elevation_m);

}  // namespace skyfit::fit
