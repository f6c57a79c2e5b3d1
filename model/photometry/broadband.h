// SPDX-License-Identifier: Apache-2.0
// Irradiance of all wavelengths, as pyranometers and pyrheliometers measure it, from quantities per
// unit solar irradiance at a few wavelengths: docs/theory (10.6) to (10.8).
//
// Approximate. The model has no water vapour, carbon dioxide and oxygen: their absorption is the
// broadband one of Bird & Hulstrom 1981 (SERI/TR-642-761, eqs. 4 and 8) along the sun's air mass,
// taken evenly from the light beyond 690 nm, where these gases absorb. Light beyond 2500 nm is as
// that at 2500 nm, with the solar spectrum of a black body; light below 300 nm is left out (ozone
// absorbs it). Against the beam of ASTM G173 the error is in docs/accuracy.md.
#pragma once

#include <vector>

#include "model/photometry/photometry.h"

namespace skyfit {

// irradiance in W/m^2 at 1 au = sum_k weight[k] * quantity per unit solar irradiance at node k.
struct BroadbandRule {
  std::vector<WavelengthNode> nodes;
  std::vector<double> weight;  // W/m^2
};

// sun_zenith in radians, below 90 deg; precipitable_water_mm >= 0, the vertical column of water
// vapour. The nodes are those of every sun. Throws std::invalid_argument outside, and for a star
// whose spectrum does not reach from 300 to 2500 nm.
BroadbandRule broadband_rule(const SpectralData& data, double sun_zenith,
                             double precipitable_water_mm);

// Relative to a vertical path, of a sun at this true zenith angle, radians, below 90 deg (Kasten &
// Young 1989).
double relative_air_mass(double sun_zenith);

// The share of the solar constant that water vapour and the uniformly mixed gases absorb.
double broadband_gas_absorptance(double air_mass, double precipitable_water_mm);

}  // namespace skyfit
