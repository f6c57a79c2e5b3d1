// SPDX-License-Identifier: Apache-2.0
#include "model/photometry.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

#include "model/discrete_measure.h"

namespace skyfit {
namespace {

constexpr double kLuminousEfficacy =
    683.002;  // lm/W, CIE 015: the peak of V is at 555 nm in air, not at 540 THz
constexpr double kFirstNm = 380.0, kStepNm = 5.0;
constexpr int kSteps =
    81;  // 380 .. 780 nm, the range where V and E_sun are both tabulated and V matters

// lm/W * colour matching * irradiance * 5 nm: lx that each wavelength contributes per unit of
// radiance per irradiance.
DiscreteMeasure photometric_measure(const SpectralData& data, const Spectrum& matching) {
  DiscreteMeasure measure;
  for (int i = 0; i < kSteps; ++i) {
    const double nm = kFirstNm + kStepNm * i;
    measure.point.push_back(nm);
    measure.weight.push_back(kLuminousEfficacy * kStepNm * matching.at(nm) *
                             data.solar_irradiance.at(nm));
  }
  return measure;
}

// The nodes with the smoothed ozone cross section. With n Gauss nodes and degree n - 1, the rule's
// first n moments of the cross section are those of the full sum; with the tabulated value at the
// node they are off by its Huggins and Chappuis structure.
std::vector<WavelengthNode> smooth_nodes(const SpectralData& data, const DiscreteMeasure& measure,
                                         const std::vector<double>& wavelengths_nm) {
  std::vector<double> ozone;
  for (const double nm : measure.point) ozone.push_back(data.ozone_cross_section.at(nm));
  const int degree = static_cast<int>(wavelengths_nm.size()) - 1;
  const std::vector<double> smooth =
      least_squares_polynomial(measure, ozone, degree, wavelengths_nm);
  std::vector<WavelengthNode> nodes;
  for (std::size_t k = 0; k < wavelengths_nm.size(); ++k) {
    nodes.push_back({wavelengths_nm[k], std::max(smooth[k], 0.0)});
  }
  return nodes;
}

// A radiance or transmittance per unit solar irradiance that a planet's sky may have:
// tau exp(-m tau - ozone), (1 - exp(-m tau)) exp(-m tau / 2 - ozone) or exp(-m tau - ozone), tau
// the vertical optical depth of air and aerosol, m an airmass.
struct ProbeSpectrum {
  double aerosol_depth_550, angstrom_exponent, airmass, ozone_per_m2;
  int form;

  double at(const WavelengthNode& node) const {
    constexpr double kAirDepth550 = 1.216e-5 * 8000.0;
    const double x = node.wavelength_nm / 550.0;
    const double tau =
        kAirDepth550 * std::pow(x, -4.08) + aerosol_depth_550 * std::pow(x, -angstrom_exponent);
    const double ozone = ozone_per_m2 * node.ozone_cross_section_m2;
    const double m = airmass;
    if (form == 0) return tau * std::exp(-m * tau - ozone);
    if (form == 1) return (1.0 - std::exp(-m * tau)) * std::exp(-0.5 * m * tau - ozone);
    return std::exp(-m * tau - ozone);
  }
};

// Spectra spread evenly (the R5 sequence, Roberts 2018) over no aerosol to a depth of 0.5,
// exponents -0.5 to 2, airmass 1 to 38 (the horizon), ozone to 600 DU under up to the same airmass.
// More than 300 of them change no weight that matters.
std::vector<ProbeSpectrum> probe_spectra() {
  constexpr std::size_t kCount = 300;
  constexpr double kRoot = 1.1347241384015194;  // of x^6 = x + 1
  constexpr double kMoleculesPerDobson = 2.687e20;
  const auto fraction = [](int i, int dimension) {
    return std::fmod(0.5 + i * std::pow(kRoot, -dimension), 1.0);
  };
  std::vector<ProbeSpectrum> probes;
  for (int i = 1; probes.size() < kCount; ++i) {
    const double aerosol = (fraction(i, 1) - 0.2) / 0.8;  // a fifth has none
    const double airmass = std::pow(38.0, fraction(i, 3));
    const ProbeSpectrum probe{
        aerosol < 0.0 ? 0.0 : 0.01 * std::pow(50.0, aerosol), -0.5 + 2.5 * fraction(i, 2), airmass,
        600.0 * kMoleculesPerDobson * fraction(i, 5) * airmass * fraction(i, 4), i % 3};
    constexpr double kDarkest = 4.0;  // aerosol depth along the path beyond which nothing is seen
    if (probe.airmass * probe.aerosol_depth_550 <= kDarkest) probes.push_back(probe);
  }
  return probes;
}

// The 3 x 4 matrix that is nearest to the 5 nm sums of the probe spectra, errors relative to X + Y
// + Z.
Eigen::Matrix<double, 3, 4> xyz_from_nodes(const SpectralData& data,
                                           const std::array<DiscreteMeasure, 3>& channels,
                                           const std::array<WavelengthNode, 4>& nodes) {
  const std::vector<WavelengthNode> fine = spectral_nodes(data, channels[0].point);
  const std::vector<ProbeSpectrum> probes = probe_spectra();
  const auto rows = static_cast<Eigen::Index>(probes.size());
  Eigen::Matrix<double, Eigen::Dynamic, 4> at_nodes(rows, 4);
  Eigen::Matrix<double, Eigen::Dynamic, 3> xyz =
      Eigen::Matrix<double, Eigen::Dynamic, 3>::Zero(rows, 3);
  for (Eigen::Index row = 0; row < rows; ++row) {
    const ProbeSpectrum& probe = probes[static_cast<std::size_t>(row)];
    for (std::size_t i = 0; i < fine.size(); ++i) {
      const double value = probe.at(fine[i]);
      for (int c = 0; c < 3; ++c) xyz(row, c) += channels[c].weight[i] * value;
    }
    for (int k = 0; k < 4; ++k) at_nodes(row, k) = probe.at(nodes[k]);
    const double sum = xyz.row(row).sum();
    xyz.row(row) /= sum;
    at_nodes.row(row) /= sum;
  }
  return at_nodes.colPivHouseholderQr().solve(xyz).transpose();
}

}  // namespace

double Spectrum::at(double nm) const {
  if (wavelength_nm.empty() || !(nm >= wavelength_nm.front() && nm <= wavelength_nm.back())) {
    throw std::out_of_range(
        wavelength_nm.empty()
            ? fmt::format("wavelength_nm = {}: the table is empty", nm)
            : fmt::format("wavelength_nm = {}: expected {} to {}, the range of the table", nm,
                          wavelength_nm.front(), wavelength_nm.back()));
  }
  const auto above = std::lower_bound(wavelength_nm.begin(), wavelength_nm.end(), nm);
  const auto i = static_cast<std::size_t>(std::distance(wavelength_nm.begin(), above));
  if (*above == nm) return value[i];
  const double t = (nm - wavelength_nm[i - 1]) / (wavelength_nm[i] - wavelength_nm[i - 1]);
  return value[i - 1] + t * (value[i] - value[i - 1]);
}

std::vector<WavelengthNode> spectral_nodes(const SpectralData& data,
                                           const std::vector<double>& wavelengths_nm) {
  std::vector<WavelengthNode> nodes;
  for (const double nm : wavelengths_nm) nodes.push_back({nm, data.ozone_cross_section.at(nm)});
  return nodes;
}

LuminanceRule luminance_rule(const SpectralData& data, int count) {
  constexpr int kMostNodes = 16;  // more gains nothing before the tables' own errors
  if (count < 1 || count > kMostNodes) {
    throw std::invalid_argument(
        fmt::format("luminance_rule.count = {}: expected 1 to {}", count, kMostNodes));
  }
  const DiscreteMeasure measure = photometric_measure(data, data.y_bar);
  const GaussRule gauss = gauss_rule(measure, count);
  return {smooth_nodes(data, measure, gauss.node), gauss.weight};
}

LuminanceRule luminance_sum_5nm(const SpectralData& data) {
  DiscreteMeasure measure = photometric_measure(data, data.y_bar);
  return {spectral_nodes(data, measure.point), std::move(measure.weight)};
}

ColorRule color_rule(const SpectralData& data) {
  const std::array<DiscreteMeasure, 3> channels = {photometric_measure(data, data.x_bar),
                                                   photometric_measure(data, data.y_bar),
                                                   photometric_measure(data, data.z_bar)};
  DiscreteMeasure all = channels[0];
  for (std::size_t i = 0; i < all.weight.size(); ++i)
    all.weight[i] += channels[1].weight[i] + channels[2].weight[i];
  // The wavelengths that reproduce the probe spectra best, found once by a simplex search with the
  // standard data.
  const std::vector<WavelengthNode> nodes = smooth_nodes(data, all, {444.3, 519.0, 585.6, 653.0});
  ColorRule rule;
  std::copy(nodes.begin(), nodes.end(), rule.nodes.begin());
  const Eigen::Matrix<double, 3, 4> matrix = xyz_from_nodes(data, channels, rule.nodes);
  for (int c = 0; c < 3; ++c) {
    for (int k = 0; k < 4; ++k) rule.xyz_from_nodes[c][k] = matrix(c, k);
  }
  return rule;
}

}  // namespace skyfit
