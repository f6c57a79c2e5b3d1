// SPDX-License-Identifier: Apache-2.0
// From radiance per unit solar irradiance to luminance and colour, with few wavelengths.
// Radiances of the model are per unit solar spectral irradiance at normal incidence (1/sr), smooth
// in wavelength; the weights V(lambda) E_sun(lambda) are not. A Gauss rule for such a weight needs
// 4 solutions instead of 81.
#pragma once

#include <array>
#include <vector>

namespace skyfit {

// A tabulated function of wavelength, ascending, linear in between.
struct Spectrum {
  std::vector<double> wavelength_nm;
  std::vector<double> value;
  double at(double nm) const;  // throws std::out_of_range outside the table
};

// The tabulated inputs of the model; data_refs/spectra.h delivers the standard ones.
struct SpectralData {
  Spectrum x_bar, y_bar, z_bar;  // CIE 1931 2 deg colour matching functions
  Spectrum solar_irradiance;     // W m^-2 nm^-1 at 1 au
  Spectrum ozone_cross_section;  // m^2 per molecule
};

// One wavelength at which the model is solved.
struct WavelengthNode {
  double wavelength_nm;
  double ozone_cross_section_m2;
};

// Nodes that read the tabulated ozone cross section as it is: for spectral radiances.
std::vector<WavelengthNode> spectral_nodes(const SpectralData& data,
                                           const std::vector<double>& wavelengths_nm);

// luminance in cd/m^2 at 1 au (or illuminance in lx) = sum_k weight[k] * quantity per unit solar
// irradiance at node k.
struct LuminanceRule {
  std::vector<WavelengthNode> nodes;
  std::vector<double> weight;  // lm/W * W/m^2 = lx
};

// Gauss rule of `count` nodes (1 to 16, otherwise std::invalid_argument) for the weight 683.002
// V(lambda) E_sun(lambda), 380..780 nm. The ozone cross section at the nodes is that of its
// weighted least-squares polynomial of degree count - 1 in wavelength, because the true one is not
// smooth. Measured on the spectra named at ColorRule: 4 nodes stay within 0.2 % of the 5 nm sum to
// airmass 12 (median 0.001 %) and within 0.6 % to 30.
LuminanceRule luminance_rule(const SpectralData& data, int count = 4);

// The plain sum over 380..780 nm by 5 nm, the yardstick of the rules.
LuminanceRule luminance_sum_5nm(const SpectralData& data);

// Four shared wavelengths, one per channel of an RGBA texel, and the matrix that turns them into
// CIE XYZ (cd/m^2, Y is luminance). Wavelengths and matrix are those nearest to the 5 nm sums of
// skylight and sunlight under airmass 1..38, aerosol of exponent -0.5..2 and ozone to 600 DU.
// Measured on such spectra: Y within 0.2 % and xy within 0.002 to airmass 15; to airmass 30 within
// 0.12 % and 0.001 for 95 % of them, at worst 1.2 % and 0.005 (the sun's own light at the horizon).
// Interpolatory weights at Gauss nodes reach 8 % and 0.03 there.
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
