// SPDX-License-Identifier: Apache-2.0
// From radiance per unit solar irradiance to luminance and colour, with few wavelengths.
// Radiances of the model are per unit solar spectral irradiance at normal incidence (1/sr), smooth
// in wavelength; the weights V(lambda) E_sun(lambda) are not. A rule that integrates such a weight
// times a polynomial needs 4 solutions instead of 81.
#pragma once

#include <array>
#include <vector>

#include "model/atmosphere/star.h"
#include "model/atmosphere/wavelength_node.h"

namespace skyfit {

// A tabulated function of wavelength, ascending, linear in between.
struct Spectrum {
  std::vector<double> wavelength_nm;
  std::vector<double> value;
  double at(double nm) const;          // throws std::out_of_range outside the table
  double at_or_zero(double nm) const;  // of a function that ends with its table, such as y_bar
  bool covers(double nm) const;
};

// The tabulated inputs of the model; data_refs/spectra.h delivers the standard ones.
struct SpectralData {
  Spectrum x_bar, y_bar, z_bar;  // CIE 1931 2 deg colour matching functions
  Spectrum solar_irradiance;     // W m^-2 nm^-1 of the sun at 1 au, or of another star, see under()
  Spectrum ozone_cross_section;  // m^2 per molecule
  // 0 beyond their tables. Of O2-O2 in m^5: times the squared number density of oxygen it is an
  // extinction.
  Spectrum oxygen_pair_cross_section{}, nitrogen_dioxide_cross_section{};
};

// The same under another star.
SpectralData under(const SpectralData& data, const Star& star);

// Whether a sky model knows sun and ozone at the wavelength.
bool has_spectra_at(const SpectralData& data, double wavelength_nm);

// The cross sections of gases as they are tabulated. Throws std::out_of_range where
// has_spectra_at() is false for want of ozone.
WavelengthNode node_at(const SpectralData& data, double wavelength_nm);

// Such nodes: for spectral radiances.
std::vector<WavelengthNode> spectral_nodes(const SpectralData& data,
                                           const std::vector<double>& wavelengths_nm);

// luminance in cd/m^2 at 1 au (or illuminance in lx) = sum_k weight[k] * quantity per unit solar
// irradiance at node k.
struct LuminanceRule {
  std::vector<WavelengthNode> nodes;
  std::vector<double> weight;  // lm/W * W/m^2 = lx
};

// 4 nodes, within 0.15 % of the 5 nm sum for every sky of the reference model with suns to 92 deg,
// views to 90 deg, ozone to 500 DU, aerosol depth to 0.9, from the ground and from 10 km
// (tests/model/rule_accuracy_test.cc). Exact for cubic polynomials in wavelength; all weights are
// positive.
LuminanceRule luminance_rule(const SpectralData& data);

// 2 nodes, within 1.5 % from the ground with suns to 88 and views to 89 deg: for a search.
LuminanceRule coarse_luminance_rule(const SpectralData& data);

// The plain sum over 380..780 nm by 5 nm, the yardstick of the rules.
LuminanceRule luminance_sum_5nm(const SpectralData& data);

// CIE XYZ in cd/m^2 (Y is luminance) = sum_k weight[c][k] * quantity per unit solar irradiance at
// node k.
struct XyzRule {
  std::vector<WavelengthNode> nodes;
  std::array<std::vector<double>, 3> weight;
};

// 6 nodes, in the domain of luminance_rule(): Y within 0.15 % and chromaticity x, y within 0.0005.
XyzRule xyz_rule(const SpectralData& data);
XyzRule xyz_sum_5nm(const SpectralData& data);

// 4 nodes, one per channel of an RGBA texel, and the matrix that turns them into CIE XYZ. In the
// domain of luminance_rule(): Y within 0.4 %, x and y within 0.004. Sunlight through airmass 30, as
// the sun's own at the horizon: 1.6 % and 0.008.
struct ColorRule {
  std::array<WavelengthNode, 4> nodes;
  std::array<std::array<double, 4>, 3> xyz_from_nodes;
};
ColorRule color_rule(const SpectralData& data);

// Linear sRGB (IEC 61966-2-1 primaries, D65) from CIE XYZ; row major.
inline constexpr std::array<std::array<double, 3>, 3> kLinearSrgbFromXyz = {
    {{3.2404542, -1.5371385, -0.4985314},
     {-0.9692660, 1.8760108, 0.0415560},
     {0.0556434, -0.2040259, 1.0572252}}};

}  // namespace skyfit
