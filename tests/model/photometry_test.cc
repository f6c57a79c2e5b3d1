// SPDX-License-Identifier: Apache-2.0
// Rules of few wavelengths equal their closed forms and the 5 nm sum on spectra that a sky may
// have.
#include "model/photometry.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <random>
#include <stdexcept>

#include "data_refs/spectra.h"
#include "model/discrete_measure.h"

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

TEST(GaussRule, OfEqualWeightsOnManyPointsIsGaussLegendre) {
  // The midpoint sum of n points differs from the integral by O(n^-2).
  constexpr int kPoints = 4000;
  constexpr double kMidpointSum = 1e-6;
  DiscreteMeasure measure;
  for (int i = 0; i < kPoints; ++i) {
    measure.point.push_back(-1 + (2.0 * i + 1) / kPoints);
    measure.weight.push_back(2.0 / kPoints);
  }
  const GaussRule rule = gauss_rule(measure, 3);
  const std::vector<double> nodes = {-std::sqrt(0.6), 0, std::sqrt(0.6)},
                            weights = {5.0 / 9, 8.0 / 9, 5.0 / 9};
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(rule.node[k], nodes[k], kMidpointSum);
    EXPECT_NEAR(rule.weight[k], weights[k], kMidpointSum);
  }
}

TEST(LuminanceRule, IsExactForPolynomialsToDegreeTwoNMinusOne) {
  constexpr double kRounding = 1e-12;  // sums of 81 terms, eigenvalues of a matrix of order one
  const LuminanceRule sum = luminance_sum_5nm(data());
  for (const int count : {1, 2, 4, 8, 16}) {
    const LuminanceRule rule = luminance_rule(data(), count);
    ASSERT_EQ(rule.nodes.size(), static_cast<std::size_t>(count));
    for (int degree = 0; degree < 2 * count; ++degree) {
      const auto moment = [&](const LuminanceRule& r) {
        double total = 0;
        for (std::size_t k = 0; k < r.nodes.size(); ++k) {
          total += r.weight[k] * std::pow((r.nodes[k].wavelength_nm - 550) / 100, degree);
        }
        return total;
      };
      EXPECT_NEAR(moment(rule) / moment(sum), 1, kRounding * std::pow(3, degree))
          << count << " " << degree;
    }
    for (const double weight : rule.weight) EXPECT_GT(weight, 0);
  }
}

TEST(LuminanceRule, FourNodesAreThePublishedOnes) {
  const LuminanceRule rule = luminance_rule(data());
  const std::vector<double> nodes = {462.7, 530.4, 592.2, 658.9};
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(rule.nodes[k].wavelength_nm, nodes[k], 0.06);
}

TEST(LuminanceRule, MomentsOfOzoneAreThoseOfTheSum) {
  // The least-squares polynomial of degree 3 under a Gauss rule of degree 7 keeps moments 0 to 3 of
  // the cross section.
  const LuminanceRule sum = luminance_sum_5nm(data()), rule = luminance_rule(data());
  for (int degree = 0; degree <= 3; ++degree) {
    const auto moment = [&](const LuminanceRule& r) {
      double total = 0;
      for (std::size_t k = 0; k < r.nodes.size(); ++k) {
        total += r.weight[k] * r.nodes[k].ozone_cross_section_m2 *
                 std::pow(r.nodes[k].wavelength_nm / 550, degree);
      }
      return total;
    };
    EXPECT_NEAR(moment(rule) / moment(sum), 1, 1e-10) << degree;
  }
}

TEST(LuminanceRule, CountIsChecked) {
  for (const int count : {0, -1, 17}) {
    EXPECT_THAT([&] { luminance_rule(data(), count); },
                ThrowsMessage<std::invalid_argument>(HasSubstr("expected 1 to 16")));
  }
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

// Independent of the spectra that color_rule() is made from: random, and of another kind of aerosol
// term.
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

struct Xyz {
  double x, y, z;
};

Xyz exact_xyz(const Sky& sky) {
  Xyz sum{0, 0, 0};
  for (int nm = 380; nm <= 780; nm += 5) {
    const double value = 683.002 * 5 * data().solar_irradiance.at(nm) *
                         sky.at({1.0 * nm, data().ozone_cross_section.at(nm)});
    sum.x += data().x_bar.at(nm) * value;
    sum.y += data().y_bar.at(nm) * value;
    sum.z += data().z_bar.at(nm) * value;
  }
  return sum;
}

double quantile(std::vector<double> values, double fraction) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1))];
}

TEST(LuminanceRule, IsWithinAFifthOfAPercentOfThe5NmSum) {
  const LuminanceRule rule = luminance_rule(data());
  const auto errors = [&](double largest_airmass) {
    std::vector<double> result;
    for (const Sky& sky : random_skies(largest_airmass)) {
      double y = 0;
      for (std::size_t k = 0; k < 4; ++k) y += rule.weight[k] * sky.at(rule.nodes[k]);
      result.push_back(std::abs(y / exact_xyz(sky).y - 1));
    }
    return result;
  };
  const std::vector<double> day = errors(12), horizon = errors(30);
  EXPECT_LT(quantile(day, 0.5), 1e-4);
  EXPECT_LT(quantile(day, 1), 2e-3);
  EXPECT_LT(quantile(horizon, 0.95), 1e-3);
  EXPECT_LT(quantile(horizon, 1), 6e-3);
}

TEST(ColorRule, IsWithinAFifthOfAPercentAndTwoThousandthsOfChromaticity) {
  const ColorRule rule = color_rule(data());
  const auto errors = [&](double largest_airmass) {
    std::array<std::vector<double>, 2> result;  // relative Y, largest of x and y
    for (const Sky& sky : random_skies(largest_airmass)) {
      std::array<double, 3> c{};
      for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 4; ++k) c[i] += rule.xyz_from_nodes[i][k] * sky.at(rule.nodes[k]);
      }
      const Xyz exact = exact_xyz(sky);
      const double sum = c[0] + c[1] + c[2], exact_sum = exact.x + exact.y + exact.z;
      result[0].push_back(std::abs(c[1] / exact.y - 1));
      result[1].push_back(std::max(std::abs(c[0] / sum - exact.x / exact_sum),
                                   std::abs(c[1] / sum - exact.y / exact_sum)));
    }
    return result;
  };
  const auto day = errors(15), horizon = errors(30);
  EXPECT_LT(quantile(day[0], 1), 2e-3);
  EXPECT_LT(quantile(day[1], 1), 2e-3);
  EXPECT_LT(quantile(horizon[0], 0.95), 2e-3);
  EXPECT_LT(quantile(horizon[1], 0.95), 2e-3);
  EXPECT_LT(quantile(horizon[0], 1), 1.2e-2);
  EXPECT_LT(quantile(horizon[1], 1), 5e-3);
}

TEST(ColorRule, SunOutsideTheAtmosphereHasItsColour) {
  // exp(0) is not among the spectra of the fit, whose airmass starts at 1.
  const ColorRule rule = color_rule(data());
  const Xyz exact = exact_xyz({0, 0, 0, 0, 0, false});
  const auto sum = [&](int i) {
    return std::accumulate(rule.xyz_from_nodes[i].begin(), rule.xyz_from_nodes[i].end(), 0.0);
  };
  EXPECT_NEAR(sum(0) / exact.x, 1, 5e-3);
  EXPECT_NEAR(sum(1) / exact.y, 1, 2e-3);
  EXPECT_NEAR(sum(2) / exact.z, 1, 5e-3);
}

TEST(ColorRule, SrgbWhiteIsD65) {
  // IEC 61966-2-1: the rows take D65 (0.95047, 1, 1.08883) to (1, 1, 1).
  for (const auto& row : kLinearSrgbFromXyz) {
    EXPECT_NEAR(row[0] * 0.95047 + row[1] + row[2] * 1.08883, 1, 1e-4);
  }
}

}  // namespace
}  // namespace skyfit
