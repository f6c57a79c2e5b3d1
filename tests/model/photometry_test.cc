// SPDX-License-Identifier: Apache-2.0
// Rules of few wavelengths equal their closed forms, and the 5 nm sum on spectra in closed form
// that a sky may have.
#include "model/photometry/photometry.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "data_refs/spectra.h"

namespace skyfit {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const SpectralData& data() { return refs::standard_spectral_data(); }

TEST(Spectrum, IsLinearBetweenAndExactAtItsPoints) {
  const Spectrum spectrum{{400, 410, 430}, {1, 3, -1}};
  EXPECT_EQ(spectrum.at(400), 1);
  EXPECT_EQ(spectrum.at(405), 2);
  EXPECT_EQ(spectrum.at(410), 3);
  EXPECT_EQ(spectrum.at(420), 1);
  EXPECT_EQ(spectrum.at(430), -1);
}

TEST(Spectrum, ThrowsOutsideItsTable) {
  const Spectrum spectrum{{400, 410}, {1, 3}};
  EXPECT_THAT([&] { spectrum.at(399.9); },
              ThrowsMessage<std::out_of_range>(
                  "wavelength_nm = 399.9: expected 400 to 410, the range of the table"));
  EXPECT_THROW(spectrum.at(410.1), std::out_of_range);
  EXPECT_THROW(spectrum.at(std::nan("")), std::out_of_range);
  EXPECT_THROW(Spectrum{}.at(400), std::out_of_range);
}

// sum of weight * ((nm - 550) / 100)^degree over a rule.
double moment(const std::vector<WavelengthNode>& nodes, const std::vector<double>& weight,
              int degree) {
  double total = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    total += weight[k] * std::pow((nodes[k].wavelength_nm - 550) / 100, degree);
  }
  return total;
}

TEST(Rules, AreExactForPolynomialsBelowTheirNumberOfNodes) {
  constexpr double kRounding = 1e-12;  // sums of 81 terms
  const LuminanceRule sum = luminance_sum_5nm(data());
  for (const LuminanceRule& rule : {luminance_rule(data()), coarse_luminance_rule(data())}) {
    for (int degree = 0; degree < static_cast<int>(rule.nodes.size()); ++degree) {
      EXPECT_NEAR(moment(rule.nodes, rule.weight, degree), moment(sum.nodes, sum.weight, degree),
                  kRounding * sum.weight[35] * std::pow(3, degree));
    }
    for (const double weight : rule.weight) EXPECT_GT(weight, 0);
  }
  const XyzRule xyz = xyz_rule(data()), xyz_sum = xyz_sum_5nm(data());
  for (std::size_t c = 0; c < 3; ++c) {
    for (int degree = 0; degree < 6; ++degree) {
      EXPECT_NEAR(moment(xyz.nodes, xyz.weight[c], degree),
                  moment(xyz_sum.nodes, xyz_sum.weight[c], degree),
                  kRounding * sum.weight[35] * std::pow(3, degree));
    }
  }
}

TEST(Rules, HaveTheNodesThatTheirCostIsStatedFor) {
  EXPECT_EQ(luminance_rule(data()).nodes.size(), 4u);
  EXPECT_EQ(coarse_luminance_rule(data()).nodes.size(), 2u);
  EXPECT_EQ(xyz_rule(data()).nodes.size(), 6u);
}

TEST(XyzSum, IsTheLuminanceSumInY) {
  EXPECT_EQ(xyz_sum_5nm(data()).weight[1], luminance_sum_5nm(data()).weight);
}

TEST(LuminanceSum, Has81WavelengthsAndTheSolarIlluminance) {
  const LuminanceRule sum = luminance_sum_5nm(data());
  ASSERT_EQ(sum.nodes.size(), 81u);
  EXPECT_EQ(sum.nodes.front().wavelength_nm, 380);
  EXPECT_EQ(sum.nodes.back().wavelength_nm, 780);
  EXPECT_EQ(sum.weight[35], 683.002 * 5 * data().solar_irradiance.at(555));
}

TEST(SpectralNodes, ReadTheCrossSectionAsItIs) {
  const std::vector<WavelengthNode> nodes = spectral_nodes(data(), {555, 600});
  EXPECT_EQ(nodes[1].ozone_cross_section_m2, data().ozone_cross_section.at(600));
  EXPECT_NEAR(nodes[0].ozone_cross_section_m2,
              0.5 * (data().ozone_cross_section.at(550) + data().ozone_cross_section.at(560)),
              1e-38);
}

// Sunlight and skylight in closed form, unlike the radiances that the nodes were found with.
struct Sky {
  double aerosol, exponent, airmass, ozone_du, ozone_airmass;
  bool source;  // scattered at the path's end, or the beam itself
  double at(const WavelengthNode& node) const {
    const double nm = node.wavelength_nm;
    const double tau = 0.0973 * std::pow(nm / 550, -4.08) + aerosol * std::pow(nm / 550, -exponent);
    return (source ? tau : 1) * std::exp(-airmass * tau - ozone_airmass * ozone_du * 2.687e20 *
                                                              node.ozone_cross_section_m2);
  }
};

std::vector<Sky> random_skies(double largest_airmass) {
  std::mt19937 generator(20250);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(generator()) / 4294967296.0;
  };
  std::vector<Sky> skies;
  while (skies.size() < 2000) {
    const double airmass = std::exp(uniform(0, std::log(largest_airmass)));
    const Sky sky{uniform(0, 0.5), uniform(-0.5, 2),        airmass,
                  uniform(0, 600), airmass * uniform(0, 1), uniform(0, 1) < 0.7};
    if (sky.airmass * sky.aerosol < 4) skies.push_back(sky);
  }
  return skies;
}

using Xyz = std::array<double, 3>;

// Of a rule given by its nodes and the three rows of its weights.
template <class Nodes, class Rows>
Xyz xyz_of(const Nodes& nodes, const Rows& rows, const Sky& sky) {
  Xyz xyz{};
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < nodes.size(); ++k) xyz[c] += rows[c][k] * sky.at(nodes[k]);
  }
  return xyz;
}

struct Errors {
  double luminance = 0, chromaticity = 0;  // relative; the larger of x and y
};

Errors worst(double largest_airmass, const auto& nodes, const auto& rows) {
  const XyzRule sum = xyz_sum_5nm(data());
  Errors errors;
  for (const Sky& sky : random_skies(largest_airmass)) {
    const Xyz exact = xyz_of(sum.nodes, sum.weight, sky), found = xyz_of(nodes, rows, sky);
    errors.luminance = std::max(errors.luminance, std::abs(found[1] / exact[1] - 1));
    for (const int c : {0, 1}) {
      errors.chromaticity =
          std::max(errors.chromaticity, std::abs(found[c] / (found[0] + found[1] + found[2]) -
                                                 exact[c] / (exact[0] + exact[1] + exact[2])));
    }
  }
  return errors;
}

TEST(LuminanceRule, HoldsSpectraInClosedForm) {
  const LuminanceRule rule = luminance_rule(data());
  const std::array<std::vector<double>, 3> rows = {rule.weight, rule.weight, rule.weight};
  EXPECT_LT(worst(12, rule.nodes, rows).luminance, 1e-3);
  EXPECT_LT(worst(30, rule.nodes, rows).luminance, 2e-3);
}

TEST(XyzRule, HoldsSpectraInClosedForm) {
  const XyzRule rule = xyz_rule(data());
  const Errors day = worst(12, rule.nodes, rule.weight),
               horizon = worst(30, rule.nodes, rule.weight);
  EXPECT_LT(day.luminance, 1e-3);
  EXPECT_LT(day.chromaticity, 1e-3);
  EXPECT_LT(horizon.luminance, 2e-3);
  EXPECT_LT(horizon.chromaticity, 2e-3);
}

TEST(ColorRule, HoldsSpectraInClosedForm) {
  const ColorRule rule = color_rule(data());
  const Errors day = worst(12, rule.nodes, rule.xyz_from_nodes),
               horizon = worst(30, rule.nodes, rule.xyz_from_nodes);
  EXPECT_LT(day.luminance, 1e-3);
  EXPECT_LT(day.chromaticity, 2e-3);
  EXPECT_LT(horizon.luminance, 2e-2);
  EXPECT_LT(horizon.chromaticity, 8e-3);
}

TEST(ColorRule, SrgbWhiteIsD65) {
  // IEC 61966-2-1: the rows take D65 (0.95047, 1, 1.08883) to (1, 1, 1).
  for (const auto& row : kLinearSrgbFromXyz) {
    EXPECT_NEAR(row[0] * 0.95047 + row[1] + row[2] * 1.08883, 1, 1e-4);
  }
}

}  // namespace
}  // namespace skyfit
