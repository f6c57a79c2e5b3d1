// SPDX-License-Identifier: Apache-2.0
#include "model/photometry/photometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <stdexcept>

#include "model/numerics/lagrange.h"

namespace skyfit {
namespace {

constexpr double kLuminousEfficacy =
    683.002;  // lm/W, CIE 015: the peak of V is at 555 nm in air, not at 540 THz
constexpr double kFirstNm = 380.0, kStepNm = 5.0;
constexpr int kSteps =
    81;  // 380 .. 780 nm, the range where V and E_sun are both tabulated and V matters

std::vector<double> wavelengths_5nm() {
  std::vector<double> nm;
  for (int i = 0; i < kSteps; ++i) nm.push_back(kFirstNm + kStepNm * i);
  return nm;
}

// docs/theory (10.1).
// lx that each wavelength contributes per unit of radiance per irradiance: lm/W * colour matching *
// irradiance * 5 nm.
std::vector<double> photometric_weights(const SpectralData& data, const Spectrum& matching) {
  std::vector<double> weights;
  for (const double nm : wavelengths_5nm()) {
    weights.push_back(kLuminousEfficacy * kStepNm * matching.at(nm) * data.solar_irradiance.at(nm));
  }
  return weights;
}

// A wavelength of a rule, and the share of the ozone cross section tabulated there that stands for
// the band around it: the table is not smooth.
struct ChosenNode {
  double wavelength_nm, ozone_share;
};

// Found once with the standard data, by minimising even powers (2 to 6) of the errors under the
// interpolatory weights below, over radiances of 23 atmospheres of the reference model: aerosol
// depths 0 to 0.9 of exponents -0.4 to 2.2, ozone 0, 300 and 500 DU, suns 0 to 92 deg, views 0 to
// 90 deg, from the ground and from 10 km.
constexpr std::array<ChosenNode, 2> kCoarseLuminance = {{{512.56, 1.402}, {596.92, 0.831}}};
constexpr std::array<ChosenNode, 4> kLuminance = {
    {{462.65, 0.816}, {525.49, 0.983}, {580.36, 1.063}, {640.74, 1.080}}};
constexpr std::array<ChosenNode, 4> kColorOfATexel = {
    {{441.47, 0.811}, {506.80, 0.999}, {564.70, 0.968}, {629.70, 1.073}}};
constexpr std::array<ChosenNode, 6> kColor = {{{427.29, 0.792},
                                               {466.33, 1.061},
                                               {526.43, 0.957},
                                               {575.13, 1.031},
                                               {626.35, 1.038},
                                               {699.11, 0.0}}};

// docs/theory (10.3).
// The weights with which the nodes reproduce the 5 nm sum of every polynomial in wavelength that
// they determine.
std::vector<double> interpolatory_weights(const SpectralData& data, const Spectrum& matching,
                                          const std::vector<WavelengthNode>& nodes) {
  std::vector<double> nm, weights(nodes.size()), lagrange(nodes.size());
  for (const WavelengthNode& node : nodes) nm.push_back(node.wavelength_nm);
  const std::vector<double> fine_nm = wavelengths_5nm(),
                            fine_weights = photometric_weights(data, matching);
  for (std::size_t i = 0; i < fine_nm.size(); ++i) {
    lagrange_weights(nm.data(), static_cast<int>(nm.size()), fine_nm[i], lagrange.data());
    for (std::size_t k = 0; k < nm.size(); ++k) weights[k] += fine_weights[i] * lagrange[k];
  }
  return weights;
}

// docs/theory (10.5).
// The cross sections at the nodes with which a weak absorption takes from the rule what it takes
// from the 5 nm sum: their means under the part of the sum that falls to each node.
std::vector<double> means_at_nodes(const Spectrum& cross_section, const SpectralData& data,
                                   std::span<const Spectrum* const> matchings,
                                   const std::vector<double>& nodes_nm) {
  const std::vector<double> fine_nm = wavelengths_5nm();
  std::vector<double> sum(nodes_nm.size()), weight(nodes_nm.size()), lagrange(nodes_nm.size());
  for (const Spectrum* matching : matchings) {
    const std::vector<double> fine_weights = photometric_weights(data, *matching);
    for (std::size_t i = 0; i < fine_nm.size(); ++i) {
      lagrange_weights(nodes_nm.data(), static_cast<int>(nodes_nm.size()), fine_nm[i],
                       lagrange.data());
      for (std::size_t k = 0; k < nodes_nm.size(); ++k) {
        weight[k] += fine_weights[i] * lagrange[k];
        sum[k] += fine_weights[i] * lagrange[k] * cross_section.at_or_zero(fine_nm[i]);
      }
    }
  }
  for (std::size_t k = 0; k < nodes_nm.size(); ++k) sum[k] = std::max(sum[k] / weight[k], 0.0);
  return sum;
}

std::vector<WavelengthNode> nodes_of(const SpectralData& data, std::span<const ChosenNode> chosen,
                                     std::span<const Spectrum* const> matchings) {
  std::vector<double> nm;
  for (const ChosenNode& node : chosen) nm.push_back(node.wavelength_nm);
  const std::vector<double> pairs =
                                means_at_nodes(data.oxygen_pair_cross_section, data, matchings, nm),
                            nitrogen_dioxide = means_at_nodes(data.nitrogen_dioxide_cross_section,
                                                              data, matchings, nm);
  std::vector<WavelengthNode> nodes;
  for (std::size_t k = 0; k < nm.size(); ++k) {
    nodes.push_back({nm[k], chosen[k].ozone_share * data.ozone_cross_section.at(nm[k]), pairs[k],
                     nitrogen_dioxide[k]});
  }
  return nodes;
}

LuminanceRule luminance_of(const SpectralData& data, std::span<const ChosenNode> chosen) {
  const std::vector<WavelengthNode> nodes = nodes_of(data, chosen, std::array{&data.y_bar});
  return {nodes, interpolatory_weights(data, data.y_bar, nodes)};
}

XyzRule xyz_of(const SpectralData& data, std::span<const ChosenNode> chosen) {
  const std::vector<WavelengthNode> nodes =
      nodes_of(data, chosen, std::array{&data.x_bar, &data.y_bar, &data.z_bar});
  return {nodes,
          {interpolatory_weights(data, data.x_bar, nodes),
           interpolatory_weights(data, data.y_bar, nodes),
           interpolatory_weights(data, data.z_bar, nodes)}};
}

}  // namespace

bool Spectrum::covers(double nm) const {
  return !wavelength_nm.empty() && nm >= wavelength_nm.front() && nm <= wavelength_nm.back();
}

bool has_spectra_at(const SpectralData& data, double wavelength_nm) {
  return data.solar_irradiance.covers(wavelength_nm) &&
         data.ozone_cross_section.covers(wavelength_nm);
}

double Spectrum::at_or_zero(double nm) const { return covers(nm) ? at(nm) : 0; }

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

SpectralData under(const SpectralData& data, const Star& star) {
  SpectralData result = data;
  Spectrum& irradiance = result.solar_irradiance;
  switch (star.spectrum) {
    case StarSpectrum::kSolar:
      for (double& value : irradiance.value) value /= star.distance_au * star.distance_au;
      break;
    case StarSpectrum::kBlackBody:
      for (std::size_t i = 0; i < irradiance.value.size(); ++i)
        irradiance.value[i] = black_body_irradiance(irradiance.wavelength_nm[i], star.temperature_k,
                                                    star.angular_radius_rad());
      break;
    case StarSpectrum::kTabulated: {  // nothing is known beyond the table
      const TwoColumns& table = star.table->table();
      std::erase_if(irradiance.wavelength_nm,
                    [&](double nm) { return nm < table.x.front() || nm > table.x.back(); });
      irradiance.value.clear();
      for (const double nm : irradiance.wavelength_nm)
        irradiance.value.push_back(star.table->at(nm));
      break;
    }
  }
  return result;
}

WavelengthNode node_at(const SpectralData& data, double wavelength_nm) {
  return {wavelength_nm, data.ozone_cross_section.at(wavelength_nm),
          data.oxygen_pair_cross_section.at_or_zero(wavelength_nm),
          data.nitrogen_dioxide_cross_section.at_or_zero(wavelength_nm)};
}

std::vector<WavelengthNode> spectral_nodes(const SpectralData& data,
                                           const std::vector<double>& wavelengths_nm) {
  std::vector<WavelengthNode> nodes;
  for (const double nm : wavelengths_nm) nodes.push_back(node_at(data, nm));
  return nodes;
}

LuminanceRule luminance_rule(const SpectralData& data) { return luminance_of(data, kLuminance); }

LuminanceRule coarse_luminance_rule(const SpectralData& data) {
  return luminance_of(data, kCoarseLuminance);
}

LuminanceRule luminance_sum_5nm(const SpectralData& data) {
  return {spectral_nodes(data, wavelengths_5nm()), photometric_weights(data, data.y_bar)};
}

XyzRule xyz_rule(const SpectralData& data) { return xyz_of(data, kColor); }

XyzRule xyz_sum_5nm(const SpectralData& data) {
  return {spectral_nodes(data, wavelengths_5nm()),
          {photometric_weights(data, data.x_bar), photometric_weights(data, data.y_bar),
           photometric_weights(data, data.z_bar)}};
}

ColorRule color_rule(const SpectralData& data) {
  const XyzRule xyz = xyz_of(data, kColorOfATexel);
  ColorRule rule{};
  std::copy(xyz.nodes.begin(), xyz.nodes.end(), rule.nodes.begin());
  for (std::size_t c = 0; c < 3; ++c) {
    std::copy(xyz.weight[c].begin(), xyz.weight[c].end(), rule.xyz_from_nodes[c].begin());
  }
  return rule;
}

}  // namespace skyfit
