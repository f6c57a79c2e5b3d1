// SPDX-License-Identifier: Apache-2.0
// Quantities of the literature that follow from an atmosphere's constituents. A cloud is what
// scatters and has a name that begins with "cloud"; aerosol is whatever else scatters with another
// phase function than Rayleigh's.
#pragma once

#include <string_view>

#include "model/atmosphere/atmosphere.h"
#include "model/atmosphere/wavelength_node.h"

namespace skyfit {

// Vertical optical depth of extinction from h = 0 to infinity; of gases with the cross sections of
// the node.
double vertical_optical_depth(const Atmosphere<double>& atmosphere,
                              const Constituent<double>& constituent, const WavelengthNode& node);

// Of all of them together at 550 nm.
double aerosol_optical_depth(const Atmosphere<double>& atmosphere);
double cloud_optical_depth(const Atmosphere<double>& atmosphere);
double rayleigh_optical_depth(const Atmosphere<double>& atmosphere);

// The aerosol that reports speak of where they speak of one: "mie", or the first; null: none.
const Constituent<double>* main_aerosol(const Atmosphere<double>& atmosphere);

// The first cloud; null: none.
const Constituent<double>* main_cloud(const Atmosphere<double>& atmosphere);

// Mean cosine of the scattering angle of a phase function at 550 nm. That of Cornette & Shanks
// 1992, eq. 9, is not g: <cos> = g 3 (4 + g^2) / (5 (2 + g^2)).
double mean_cosine(const PhaseFunction<double>& phase);

// Of a constituent that scatters, at 550 nm.
double single_scattering_albedo(const Constituent<double>& constituent);

// As it is stated; of particles with a size distribution that of their scattering from 440 to 675
// nm.
double angstrom_exponent(const Constituent<double>& constituent);

// Of the main aerosol; 0 where there is none.
double aerosol_mean_cosine(const Atmosphere<double>& atmosphere);

// In words, the phase function of the main aerosol: "one lobe", "no aerosol".
std::string_view aerosol_kind(const Atmosphere<double>& atmosphere);

// Of the standard atmosphere (ISO 2533) at a height above the sea, metres, below 11 km.
double standard_pressure_hpa(double elevation_m);

// Of every constituent with Rayleigh's phase function, and of the pairs of oxygen molecules.
void set_site_pressure(Atmosphere<double>& atmosphere, double pressure_hpa);

}  // namespace skyfit
