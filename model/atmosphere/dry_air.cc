// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/dry_air.h"

#include <cmath>
#include <numbers>

namespace skyfit {
namespace {

constexpr double kNitrogen = 78.084, kOxygen = 20.946, kArgon = 0.934;  // percent of volume
constexpr double kPascalPerHpa = 100;

double inverse_square_um(double wavelength_nm) { return 1e6 / (wavelength_nm * wavelength_nm); }

double percent(double co2_ppm) { return 1e-4 * co2_ppm; }

}  // namespace

double refractive_index_of_air(double wavelength_nm, double co2_ppm) {
  const double s = inverse_square_um(wavelength_nm);
  const double refractivity_300 =
      1e-8 * (8060.51 + 2480990 / (132.274 - s) + 17455.7 / (39.32957 - s));
  return 1 + refractivity_300 * (1 + 0.54 * (1e-6 * co2_ppm - 0.0003));
}

double king_factor(double wavelength_nm, double co2_ppm) {
  constexpr double kOfArgon = 1.00, kOfCo2 = 1.15;
  const double s = inverse_square_um(wavelength_nm);
  const double of_nitrogen = 1.034 + 3.17e-4 * s;
  const double of_oxygen = 1.096 + 1.385e-3 * s + 1.448e-4 * s * s;
  const double co2 = percent(co2_ppm);
  return (kNitrogen * of_nitrogen + kOxygen * of_oxygen + kArgon * kOfArgon + co2 * kOfCo2) /
         (kNitrogen + kOxygen + kArgon + co2);
}

double king_depolarisation(double wavelength_nm, double co2_ppm) {
  const double factor = king_factor(wavelength_nm, co2_ppm);
  return 6 * (factor - 1) / (3 + 7 * factor);
}

double rayleigh_cross_section_m2(double wavelength_nm, double co2_ppm) {
  constexpr double kMoleculesPerM3 = 2.546899e25;  // at 288.15 K and 1013.25 hPa
  constexpr double kPi = std::numbers::pi;
  const double n = refractive_index_of_air(wavelength_nm, co2_ppm), squared = n * n;
  const double lorentz = (squared - 1) / (squared + 2);
  const double wavelength_m = 1e-9 * wavelength_nm;
  return 24 * kPi * kPi * kPi * lorentz * lorentz * king_factor(wavelength_nm, co2_ppm) /
         (std::pow(wavelength_m, 4) * kMoleculesPerM3 * kMoleculesPerM3);
}

double air_column_per_hpa(double co2_ppm) {
  constexpr double kAvogadro = 6.0221367e23;  // 1/mol, as the paper has it
  // Gravity at 45 deg, where the cosine of twice the latitude is 0, at the height zc in m.
  constexpr double kMeanHeight = 5517.56;
  constexpr double kGravity = 9.80616 - 3.085462e-6 * kMeanHeight +
                              7.254e-13 * kMeanHeight * kMeanHeight -
                              1.517e-19 * kMeanHeight * kMeanHeight * kMeanHeight;
  const double kg_per_mol = 1e-3 * (15.0556e-6 * co2_ppm + 28.9595);
  return kPascalPerHpa * kAvogadro / (kg_per_mol * kGravity);
}

double oxygen_pair_column(double pressure_hpa, double temperature_k) {
  constexpr double kBoltzmann = 1.380649e-23;  // J/K
  constexpr double kLapse = 6.5e-3;            // K/m
  constexpr double kExponent = 5.25588;        // of the pressure: g M / (R lapse)
  // The density is (1 - lapse h / T)^(exponent - 1).
  const double height = temperature_k / (kLapse * (2 * kExponent - 1));
  const double oxygen =
      0.01 * kOxygen * kPascalPerHpa * pressure_hpa / (kBoltzmann * temperature_k);
  return oxygen * oxygen * height;
}

}  // namespace skyfit
