// SPDX-License-Identifier: Apache-2.0
#include "model/photometry/second_light.h"

#include <cmath>
#include <numeric>
#include <stdexcept>

#include "model/numerics/angles.h"

namespace skyfit {
namespace {

// Kieffer & Stone 2005, table 4: a_0 to a_3 of the logarithm of the reflectance, by powers of the
// phase angle in radians.
struct MoonBand {
  double wavelength_nm;
  std::array<double, 4> a;
};
constexpr MoonBand kMoonBands[] = {{350.0, {-2.67511, -1.78539, 0.50612, -0.25578}},
                                   {355.1, {-2.71924, -1.74298, 0.44523, -0.23315}},
                                   {405.0, {-2.35754, -1.72134, 0.40337, -0.21105}},
                                   {412.3, {-2.34185, -1.74337, 0.42156, -0.21512}},
                                   {414.4, {-2.43367, -1.72184, 0.43600, -0.22675}},
                                   {441.6, {-2.31964, -1.72114, 0.37286, -0.19304}},
                                   {465.8, {-2.35085, -1.66538, 0.41802, -0.22541}},
                                   {475.0, {-2.28999, -1.63180, 0.36193, -0.20381}},
                                   {486.9, {-2.23351, -1.68573, 0.37632, -0.19877}},
                                   {544.0, {-2.13864, -1.60613, 0.27886, -0.16426}},
                                   {549.1, {-2.10782, -1.66736, 0.41697, -0.22026}},
                                   {553.8, {-2.12504, -1.65970, 0.38409, -0.20655}},
                                   {665.1, {-1.88914, -1.58096, 0.30477, -0.17908}},
                                   {693.1, {-1.89410, -1.58509, 0.28080, -0.16427}},
                                   {703.6, {-1.92103, -1.60151, 0.36924, -0.20567}},
                                   {745.3, {-1.86896, -1.57522, 0.33712, -0.19415}},
                                   {763.7, {-1.85258, -1.47181, 0.14377, -0.11589}},
                                   {774.8, {-1.80271, -1.59357, 0.36351, -0.20326}},
                                   {865.3, {-1.74561, -1.58482, 0.35009, -0.19569}}};
constexpr double kColorPhase = 30 * kRadiansPerDegree;

Spectrum moon_reflectances() {
  Spectrum spectrum;
  for (const auto& [nm, a] : kMoonBands) {
    spectrum.wavelength_nm.push_back(nm);
    spectrum.value.push_back(
        std::exp(a[0] + kColorPhase * (a[1] + kColorPhase * (a[2] + kColorPhase * a[3]))));
  }
  return spectrum;
}

template <class Weights>
double sum_of(const Weights& weights) {
  return std::accumulate(weights.begin(), weights.end(), 0.0);
}

// The factor that gives weights of luminance the illuminance of the star's.
template <class Weights>
double to_illuminance_of(const Weights& star, const Weights& weights) {
  const double sum = sum_of(weights);
  if (!(sum > 0)) throw std::invalid_argument("a star of no illuminance: expected light");
  return sum_of(star) / sum;
}

ColorRule scaled(ColorRule rule, const ColorRule& star) {
  const double factor = to_illuminance_of(star.xyz_from_nodes[1], rule.xyz_from_nodes[1]);
  for (auto& weights : rule.xyz_from_nodes) {
    for (double& weight : weights) weight *= factor;
  }
  return rule;
}

LuminanceRule scaled(LuminanceRule rule, const LuminanceRule& star) {
  const double factor = to_illuminance_of(star.weight, rule.weight);
  for (double& weight : rule.weight) weight *= factor;
  return rule;
}

}  // namespace

double illuminance_of(const SpectralData& spectra) {
  return sum_of(luminance_sum_5nm(spectra).weight);
}

ColorRule color_rule_under(const SpectralData& spectra, const ColorRule& star) {
  return scaled({star.nodes, color_rule(spectra).xyz_from_nodes}, star);
}

LuminanceRule luminance_rule_under(const SpectralData& spectra, const LuminanceRule& star) {
  return scaled({star.nodes, luminance_rule(spectra).weight}, star);
}

ColorRule moonlight_color_rule(const ColorRule& star) {
  ColorRule rule = star;
  for (auto& weights : rule.xyz_from_nodes) {
    for (std::size_t k = 0; k < weights.size(); ++k)
      weights[k] *= moon_reflectance(star.nodes[k].wavelength_nm);
  }
  return scaled(rule, star);
}

LuminanceRule moonlight_luminance_rule(const LuminanceRule& star) {
  LuminanceRule rule = star;
  for (std::size_t k = 0; k < rule.weight.size(); ++k)
    rule.weight[k] *= moon_reflectance(star.nodes[k].wavelength_nm);
  return scaled(rule, star);
}

double moon_reflectance(double wavelength_nm) {
  static const Spectrum reflectances = moon_reflectances();
  return reflectances.at(wavelength_nm);
}

double moon_illuminance_share(double phase) {
  constexpr double kFullMoon = -12.73, kSun = -26.76;  // V
  const double a = std::abs(phase) * kDegreesPerRadian;
  return std::pow(10, -0.4 * (kFullMoon - kSun + 0.026 * a + 4e-9 * a * a * a * a));
}

}  // namespace skyfit
