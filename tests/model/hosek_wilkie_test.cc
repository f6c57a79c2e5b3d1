// SPDX-License-Identifier: Apache-2.0
// `hosek-wilkie` is the authors' own code, has no steps over the turbidity, and refuses what it has
// no coefficients for.
#include "model/literature/hosek_wilkie.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "data_refs/csv.h"
#include "data_refs/spectra.h"
#include "model/registry.h"

namespace skyfit {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

constexpr double kDegree = std::numbers::pi / 180;
constexpr SkyPoint kSide{0, 40 * kDegree, 60 * kDegree, 90 * kDegree};

double angle_from_sun(const SkyPoint& p) {
  return std::acos(std::cos(p.sun_zenith) * std::cos(p.view_zenith) +
                   std::sin(p.sun_zenith) * std::sin(p.view_zenith) * std::cos(p.relative_azimuth));
}

std::array<double, 3> formula(double turbidity, double albedo, const SkyPoint& p) {
  const std::array<HosekWilkieShapes, 3> shapes = hosek_wilkie_shapes(p.sun_zenith);
  std::array<double, 3> xyz{};
  for (std::size_t c = 0; c < 3; ++c)
    xyz[c] = hosek_wilkie_light(hosek_wilkie_shape(shapes[c], turbidity, albedo),
                                std::cos(p.view_zenith), angle_from_sun(p));
  return xyz;
}

// An atmosphere of that turbidity.
Atmosphere<double> atmosphere(double turbidity, double albedo) {
  Atmosphere<double> a;
  a.at("mie").amount *= (turbidity - 1) / (literature::turbidity_of(a) - 1);
  a.ground_albedo = albedo;
  return a;
}

SkyValues radiance(const Atmosphere<double>& a, std::span<const WavelengthNode> nodes,
                   const SkyPoint& point) {
  return make_sky_model("hosek-wilkie", refs::standard_spectral_data(), 1)
      ->radiance(a, nodes, {&point, 1}, {});
}

// Turbidities 1 to 10, albedos 0 to 1, suns 5 to 85 deg, views 0 to 89 deg.
TEST(HosekWilkie, IsTheAuthorsCode) {
  constexpr double kPrinted = 1e-10;  // 12 digits
  const std::string file = SKYFIT_TEST_DATA "/hosek_wilkie.csv";
  std::ifstream in(file);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const refs::CsvTable table(text, file);
  ASSERT_EQ(table.records().size(), 480U);
  for (const refs::CsvRecord& row : table.records()) {
    const auto number = [&](const char* column) { return table.number(row, column); };
    const SkyPoint point{0, number("sun_zenith_deg") * kDegree, number("view_zenith_deg") * kDegree,
                         number("relative_azimuth_deg") * kDegree};
    const std::array<double, 3> xyz = formula(number("turbidity"), number("albedo"), point);
    EXPECT_NEAR(xyz[0] / number("X"), 1, kPrinted) << "line " << row.line;
    EXPECT_NEAR(xyz[1] / number("Y"), 1, kPrinted) << "line " << row.line;
    EXPECT_NEAR(xyz[2] / number("Z"), 1, kPrinted) << "line " << row.line;
  }
}

TEST(HosekWilkie, HasNoStepsOverTheTurbidity) {
  constexpr double kStep = 1e-9, kChange = 1e-7;  // 100 % over a hundredth of the turbidity
  for (int turbidity = 2; turbidity < 10; ++turbidity) {
    const std::array<double, 3> below = formula(turbidity - kStep, 0.2, kSide),
                                above = formula(turbidity + kStep, 0.2, kSide);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(below[c] / above[c], 1, kChange) << "turbidity " << turbidity;
  }
}

// By turbidity and albedo, in every interval of the turbidity.
TEST(HosekWilkie, DerivativesEqualDifferences) {
  constexpr double kStep = 1e-4, kDifference = 1e-6;  // relative to the value
  const std::array<HosekWilkieShapes, 3> shapes = hosek_wilkie_shapes(kSide.sun_zenith);
  for (double turbidity = 1.3; turbidity < 10; turbidity += 1) {
    const auto t = Dual<2>::variable(turbidity, 0), albedo = Dual<2>::variable(0.3, 1);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto light = [&]<class T>(const T& turbid, const T& ground) {
        return hosek_wilkie_light(hosek_wilkie_shape(shapes[c], turbid, ground),
                                  std::cos(kSide.view_zenith), angle_from_sun(kSide));
      };
      const Dual<2> exact = light(t, albedo);
      EXPECT_NEAR(
          (light(turbidity + kStep, 0.3) - light(turbidity - kStep, 0.3)) / (2 * kStep) / exact.v,
          exact.d[0] / exact.v, kDifference);
      EXPECT_NEAR(
          (light(turbidity, 0.3 + kStep) - light(turbidity, 0.3 - kStep)) / (2 * kStep) / exact.v,
          exact.d[1] / exact.v, kDifference);
    }
  }
}

// The spectrum has the colour of the formula.
TEST(HosekWilkie, SpectrumHasTheColour) {
  const XyzRule sum = xyz_sum_5nm(refs::standard_spectral_data());
  const SkyValues sky = radiance(atmosphere(3.4, 0.25), sum.nodes, kSide);
  const std::array<double, 3> expected = formula(3.4, 0.25, kSide);
  for (std::size_t c = 0; c < 3; ++c) {
    double light = 0;
    for (std::size_t k = 0; k < sum.nodes.size(); ++k) light += sum.weight[c][k] * sky.value[k];
    EXPECT_NEAR(light / expected[c], 1, 1e-9);
  }
}

TEST(HosekWilkie, RefusesWhatItHasNoCoefficientsFor) {
  const WavelengthNode green{550, 0};
  const auto sky = [&](double turbidity, const SkyPoint& point) {
    return [=] { radiance(atmosphere(turbidity, 0.1), {&green, 1}, point); };
  };
  EXPECT_THAT(sky(11, kSide),
              ThrowsMessage<std::domain_error>(HasSubstr("11: must be in 1 .. 10")));
  EXPECT_NO_THROW(sky(10, kSide)());
  EXPECT_NO_THROW(sky(1, kSide)());
  EXPECT_THAT(
      sky(3, {3100, 0.5, 0.5, 0}),
      ThrowsMessage<std::invalid_argument>(HasSubstr("altitude_m = 3100: must be at most 3000")));
  EXPECT_THROW(sky(3, {0, 1.6, 0.5, 0})(), std::invalid_argument);  // twilight
  EXPECT_THROW(sky(3, {0, 0.5, 2, 0})(), std::invalid_argument);    // ground
}

TEST(HosekWilkie, IsDarkWithoutAir) {
  const WavelengthNode green{550, 0};
  Atmosphere<double> none;
  none.at("rayleigh").amount = none.at("mie").amount = 0;
  EXPECT_EQ(radiance(none, {&green, 1}, kSide).at(0, 0), 0);
}

}  // namespace
}  // namespace skyfit
