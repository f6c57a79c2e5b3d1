// SPDX-License-Identifier: Apache-2.0
// With the sun's depression the light of the sky falls, and stays above 0, to the end of twilight;
// it is that of Monte Carlo as closely as docs/theory, chapter 7, states.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "data_refs/references.h"
#include "model/atmosphere/preset.h"
#include "model/solver/reference_model.h"
#include "tests/atmospheres.h"
#include "tests/model/truth.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

void expect_falling(const Atmosphere<double>& a, Transfer transfer) {
  constexpr double kViews[] = {0, 30, 60, 80, 85}, kAzimuths[] = {0, 45, 90, 135, 180};
  std::vector<double> suns;
  for (double sun = 92; sun <= 108; sun += 0.5) suns.push_back(sun);
  std::vector<SkyPoint> points;
  for (const double sun : suns) {
    for (const double view : kViews) {
      for (const double azimuth : kAzimuths)
        points.push_back({0, sun * kDegree, view * kDegree, azimuth * kDegree});
    }
  }
  ReferenceOptions options;
  options.transfer = transfer;
  options.threads = 2;
  const WavelengthNode node{550, 3e-25};
  const SkyValues sky = ReferenceModel(options).radiance(a, {&node, 1}, points, {});
  const std::size_t directions = points.size() / suns.size();
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_GT(sky.value[i], 0) << "sun " << suns[i / directions] << " direction " << i % directions;
    if (i < directions) continue;
    EXPECT_LT(sky.value[i], sky.value[i - directions])
        << "sun " << suns[i / directions] << " direction " << i % directions;
  }
}

TEST(DeepTwilight, FallsWithTheSunsDepression) {
  for (const double air : {4.5e-6, 1.216e-5, 3.2e-5}) {
    Atmosphere<double> a;
    set_scattering(a.at("rayleigh"), 550, air, 4.08);
    set_scattering(a.at("mie"), 550, 9e-5, 1.3);
    a.at("mie").phase = {PhaseType::kTwoLobe, 0, 0.8, 0.3, 0.6};
    for (const Transfer transfer : {Transfer::kVector, Transfer::kScalar})
      expect_falling(a, transfer);
  }
}

// Under every shipped preset, whose light decays faster and more slowly than in clear air.
TEST(SlowDeepTwilight, FallsUnderEveryShippedPreset) {
  constexpr double kViews[] = {0, 60, 80}, kAzimuths[] = {0, 90, 180};
  // What the sun lights from below: a layer of dust over the horizon rises by so much.
  constexpr double kGlow = 1.1;
  const std::vector<WavelengthNode> nodes = {{450, 0}, {550, 0}, {650, 0}, {700, 0}};
  for (const std::string& name : refs::shipped_preset_names()) {
    const Atmosphere<double> a = parse_preset(refs::shipped_preset_json(name), name).atmosphere;
    std::vector<SkyPoint> points;
    for (double sun = 91; sun <= 107; sun += 0.75) {
      for (const double view : kViews) {
        for (const double azimuth : kAzimuths)
          points.push_back({0, sun * kDegree, view * kDegree, azimuth * kDegree});
      }
    }
    ReferenceOptions options;
    options.transfer = Transfer::kScalar;
    options.threads = 2;
    const SkyValues sky = ReferenceModel(options).radiance(a, nodes, points, {});
    const std::size_t step = std::size(kViews) * std::size(kAzimuths);
    for (std::size_t p = 0; p < points.size(); ++p) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const double value = sky.at(static_cast<int>(p), static_cast<int>(k));
        const auto where = [&] {
          return testing::Message()
                 << name << " at " << nodes[k].wavelength_nm << " nm, sun "
                 << points[p].sun_zenith / kDegree << " view " << points[p].view_zenith / kDegree
                 << " azimuth " << points[p].relative_azimuth / kDegree;
        };
        EXPECT_GT(value, 0) << where();
        if (p < step) continue;
        EXPECT_LT(value, kGlow * sky.at(static_cast<int>(p - step), static_cast<int>(k)))
            << where();
      }
    }
  }
}

// With few levels a ray's way through a layer turns the zenith by more than the twilight spans.
TEST(DeepTwilight, OfFewLevelsIsOfTheSameSize) {
  ReferenceOptions options;
  options.levels = 4;
  const WavelengthNode node{550, 0};
  const Atmosphere<double> a = truth::monte_carlo_case("twilight-clear").atmosphere;
  for (const double sun : {88.0, 95.0}) {
    const SkyPoint p{0, sun * kDegree, 85 * kDegree, 0};
    const double few = ReferenceModel(options).radiance(a, {&node, 1}, {&p, 1}, {}).value[0],
                 all = ReferenceModel({}).radiance(a, {&node, 1}, {&p, 1}, {}).value[0];
    EXPECT_LT(std::abs(std::log2(few / all)), 1) << sun;  // four levels know no more
  }
}

// Single directions and the mean of all, beyond three and two times the noise of the Monte Carlo.
struct Stated {
  std::string of;
  double direction;
  double (*bias)(double sun_deg);
};
void PrintTo(const Stated& stated, std::ostream* out) { *out << stated.of; }
class DeepTwilightTruth : public testing::TestWithParam<Stated> {};

TEST_P(DeepTwilightTruth, IsMetAsStated) {
  std::map<double, std::vector<truth::Row>> by_sun;
  for (const truth::Row& row : truth::read_rows("deep_twilight.csv"))
    if (row.field[0] == GetParam().of) by_sun[row.number(1)].push_back(row);
  ASSERT_EQ(by_sun.size(), 6u);
  ReferenceOptions options;
  options.transfer = Transfer::kScalar;
  const truth::MonteCarloCase c = truth::monte_carlo_case(GetParam().of);
  const WavelengthNode node{550, 0};
  for (const auto& [sun_deg, rows] : by_sun) {
    std::vector<SkyPoint> points;
    for (const truth::Row& row : rows)
      points.push_back({0, sun_deg * kDegree, row.number(2) * kDegree, row.number(3) * kDegree});
    const SkyValues sky = ReferenceModel(options).radiance(c.atmosphere, {&node, 1}, points, {});
    double bias = 0, noise = 0;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double truth = rows[k].number(4) + rows[k].number(5), sigma = rows[k].number(6) / truth,
                   error = sky.value[k] / truth - 1;
      EXPECT_LT(std::abs(error), GetParam().direction + 3 * sigma)
          << "sun " << sun_deg << " view " << rows[k].number(2) << " azimuth " << rows[k].number(3);
      bias += error / static_cast<double>(rows.size());
      noise += sigma * sigma;
    }
    noise = std::sqrt(noise) / static_cast<double>(rows.size());
    std::cout << "sun " << sun_deg << ": " << 100 * bias << " % too bright, noise of the truth "
              << 100 * noise << " %\n";
    EXPECT_LT(std::abs(bias), GetParam().bias(sun_deg) + 2 * noise);
  }
}

INSTANTIATE_TEST_SUITE_P(
    , DeepTwilightTruth,
    testing::Values(Stated{"twilight-clear", 0.03,
                           [](double sun) { return sun < 95   ? 0.001
                                                   : sun < 98 ? 0.01
                                                              : 0.03; }},
                    Stated{"mars", 0.08,
                           [](double sun) { return sun < 99    ? 0.027
                                                   : sun < 101 ? 0.05
                                                               : 0.08; }}),
    [](const auto& test) { return test.param.of == "mars" ? "DustOnMars" : "ClearAirOnEarth"; });

}  // namespace
}  // namespace skyfit
