// SPDX-License-Identifier: Apache-2.0
#include "model/photometry.h"

#include <fmt/format.h>

#include <algorithm>
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

// Weights at the nodes of the measure's sum over the polynomial through the nodes.
std::array<double, 4> interpolatory_weights(const DiscreteMeasure& measure,
                                            const std::array<WavelengthNode, 4>& nodes) {
  std::array<double, 4> weights{};
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    for (std::size_t i = 0; i < measure.point.size(); ++i) {
      double lagrange = 1.0;
      for (std::size_t j = 0; j < nodes.size(); ++j) {
        if (j == k) continue;
        lagrange *= (measure.point[i] - nodes[j].wavelength_nm) /
                    (nodes[k].wavelength_nm - nodes[j].wavelength_nm);
      }
      weights[k] += measure.weight[i] * lagrange;
    }
  }
  return weights;
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
  const std::vector<WavelengthNode> nodes = smooth_nodes(data, all, gauss_rule(all, 4).node);
  ColorRule rule;
  std::copy(nodes.begin(), nodes.end(), rule.nodes.begin());
  for (std::size_t c = 0; c < 3; ++c)
    rule.xyz_from_nodes[c] = interpolatory_weights(channels[c], rule.nodes);
  return rule;
}

}  // namespace skyfit
