// SPDX-License-Identifier: Apache-2.0
// Dry air: how it scatters (Bodhaine, Wood, Dutton & Slusser 1999, J. Atmos. Oceanic Technol. 16,
// 1854-1861) and how many of its molecules stand above the ground. Wavelengths in nm, 185 to 2500;
// pressures in hPa; CO2 in parts per million by volume.
#pragma once

namespace skyfit {

// King's factor F(air), equations (5), (6) and (23).
double king_factor(double wavelength_nm, double co2_ppm);

// Equations (18) and (19), at 288.15 K and 1013.25 hPa.
double refractive_index_of_air(double wavelength_nm, double co2_ppm);

// The depolarisation ratio of natural light scattered at a right angle that belongs to King's
// factor: F = (6 + 3 rho) / (6 - 7 rho).
double king_depolarisation(double wavelength_nm, double co2_ppm);

// m^2 per molecule, equation (2) with the refractive index of (18) and (19).
double rayleigh_cross_section_m2(double wavelength_nm, double co2_ppm);

// Molecules per m^2 above a ground where the pressure is 1 hPa, equations (14) to (17): with the
// gravity of 45 deg of latitude at the mean height of the air over a ground at sea level. Gravity
// is 0.26 % less at the equator, as much more at the poles, and falls by 0.02 % per km of the site.
double air_column_per_hpa(double co2_ppm);

// Pairs of oxygen molecules above the ground, the integral of the squared number density, in m^-5:
// of 20.946 % oxygen in the troposphere of the U.S. Standard Atmosphere 1976, whose temperature
// falls by 6.5 K per km, over a ground of this pressure and temperature (K). It goes as
// pressure^2 / temperature.
double oxygen_pair_column(double pressure_hpa, double temperature_k);

}  // namespace skyfit
