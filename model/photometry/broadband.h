// SPDX-License-Identifier: Apache-2.0
// Irradiance of all wavelengths, as pyranometers and pyrheliometers measure it, from quantities per
// unit solar irradiance at a few wavelengths: docs/theory (10.6) and (10.7).
//
// Approximate. The model has no water vapour, carbon dioxide and oxygen: the transmittance of these
// gases is that of SPECTRL2 (Bird & Riordan 1984) along the sun's path at the sea's level, for the
// beam and for the light of the sky alike. Light of 2500 to 4000 nm is a black body's that goes
// through air and aerosol as that at 2500 nm; beyond and below 300 nm there is none. The beam of
// ASTM G173 comes out 1 % darker than its table says (tests/fit/irradiance_fit_test.cc).
#pragma once

#include <vector>

#include "model/photometry/photometry.h"

namespace skyfit {

// Absorption coefficients of SPECTRL2: of water vapour per cm of precipitable water, and of the
// uniformly mixed gases (a pure number); up to 4000 nm, 0 below the tables.
struct GasAbsorption {
  Spectrum water_vapour, mixed_gases;
};

// irradiance in W/m^2 at 1 au = sum_k weight[k] * quantity per unit solar irradiance at node k.
struct BroadbandRule {
  std::vector<WavelengthNode> nodes;
  std::vector<double> weight;  // W/m^2
};

// sun_zenith in radians, below 90 deg; precipitable_water_mm >= 0, the vertical column of water
// vapour. The nodes are those of every sun. Throws std::invalid_argument outside, and for a star
// whose spectrum does not reach from 300 to 2500 nm.
BroadbandRule broadband_rule(const SpectralData& data, const GasAbsorption& gases,
                             double sun_zenith, double precipitable_water_mm);

// Relative to a vertical path, of a sun at this true zenith angle, radians, below 90 deg (Kasten &
// Young 1989).
double relative_air_mass(double sun_zenith);

// Of the gases along that path.
double gas_transmittance(const GasAbsorption& gases, double wavelength_nm, double air_mass,
                         double precipitable_water_mm);

}  // namespace skyfit
