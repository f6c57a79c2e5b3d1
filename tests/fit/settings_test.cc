// SPDX-License-Identifier: Apache-2.0
// One fit: under every link and scale a sky of known parameters gives them back, with the scale
// that made it, and what belongs to a fit works for CIE skies and measured ones alike.
#include <gtest/gtest.h>

#include <random>

#include "fit/fit.h"
#include "fit/uncertainty/checks.h"
#include "tests/fit/scans.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

// Absolute luminances of the toy sky at four suns, times a scale of each scan.
refs::Reference luminances(const std::vector<double>& scales, double noise) {
  refs::Reference reference = synthetic_reference(true_atmosphere(1), noise);
  reference.quantity = refs::Quantity::kLuminance;
  for (refs::Sample& sample : reference.samples)
    sample.value *= scales[static_cast<std::size_t>(sample.scan)];
  return reference;
}

FitOptions determined() {
  FitOptions options;
  options.start = power_law_air();
  options.lobes = 1;
  options.use_priors = false;
  options.pointing = Pointing::kStated;
  options.free =
      std::vector{Parameter::kMieScattering, Parameter::kMiePhaseG, Parameter::kGroundAlbedo};
  options.fix = {{Parameter::kRayleighScattering, 1.25e-5},
                 {Parameter::kRayleighScaleHeight, 8000},
                 {Parameter::kMieScaleHeight, 1200},
                 {Parameter::kMieSingleScatteringAlbedo, 0.93}};
  return options;
}

Result fit_toy(const refs::Reference& reference, const FitOptions& options) {
  return fit_atmosphere(reference, refs::standard_spectral_data(), ToySky(), options);
}

double scale_of(const Result& result, std::size_t scan) {
  return result.scans[scan].instrument[static_cast<std::size_t>(Instrument::kScale)];
}

class SettingsTest : public testing::TestWithParam<std::tuple<Link, Scale>> {};

TEST_P(SettingsTest, KnownSkyAndScalesAreFound) {
  const auto [link, scale] = GetParam();
  std::vector<double> scales = {1, 1, 1, 1};
  if (scale == Scale::kShared) scales = {1.3, 1.3, 1.3, 1.3};
  if (scale == Scale::kPerScan || scale == Scale::kProfiled) scales = {0.8, 1.1, 1.3, 0.9};
  FitOptions options = determined();
  options.link = link;
  options.scale = scale;
  options.noise = NoiseModel{0.02, 0};
  const Result result = fit_toy(luminances(scales, 0.02), options);
  EXPECT_TRUE(result.converged);
  EXPECT_EQ(result.likelihood.link, link);
  EXPECT_EQ(result.likelihood.scale, scale);
  for (const UnknownRow& row : result.unknowns) {
    const Parameter* parameter = std::get_if<Parameter>(&row.unknown.what);
    if (parameter == nullptr) continue;
    EXPECT_GT(row.sigma, 0) << row.unknown.name();
    EXPECT_NEAR(row.fitted, get_parameter(true_atmosphere(1), *parameter), 3 * row.sigma)
        << row.unknown.name();
  }
  constexpr double kScale = 0.03;  // 33 directions of 2 % noise, and the shape of the sky
  for (std::size_t scan = 0; scan < scales.size(); ++scan)
    EXPECT_NEAR(scale_of(result, scan) / scales[scan], 1, kScale) << scan;
  EXPECT_NEAR(result.chi_square_per_dof, 1, 0.4);  // 120 degrees of freedom: 0.13 one sigma
}

INSTANTIATE_TEST_SUITE_P(All, SettingsTest,
                         testing::Combine(testing::Values(Link::kLog, Link::kLinear),
                                          testing::Values(Scale::kFixed, Scale::kShared,
                                                          Scale::kPerScan, Scale::kProfiled)));

// A profiled scale is the unknown scale without a prior: the same answer and the same sigma.
TEST(SettingsTest, ProfiledEqualsPerScanWithoutPrior) {
  for (const Link link : {Link::kLog, Link::kLinear}) {
    FitOptions options = determined();
    options.link = link;
    options.noise = NoiseModel{0.02, 0};
    const refs::Reference reference = luminances({0.8, 1.1, 1.3, 0.9}, 0.02);
    options.scale = Scale::kPerScan;
    const Result free = fit_toy(reference, options);
    options.scale = Scale::kProfiled;
    const Result profiled = fit_toy(reference, options);
    constexpr double kSolved = 2e-2;  // of sigma, at the linear link's cost tolerance of 1e-5
    for (const UnknownRow& row : profiled.unknowns) {
      const UnknownRow& other = free.unknown(row.unknown.name());
      EXPECT_NEAR(row.fitted, other.fitted, kSolved * row.sigma) << row.unknown.name();
      EXPECT_NEAR(row.sigma / other.sigma, 1, 1e-2) << row.unknown.name();
    }
  }
}

// The defaults depend on the quantity alone.
TEST(SettingsTest, DefaultsAreThoseOfTheQuantity) {
  refs::Reference reference = synthetic_reference(true_atmosphere(1), 0.02);
  FitOptions options;
  Likelihood likelihood = likelihood_of(options, reference);
  EXPECT_EQ(likelihood.link, Link::kLog);
  EXPECT_EQ(likelihood.scale, Scale::kProfiled);
  EXPECT_EQ(pointing_of(options, reference), Pointing::kStated);
  options.loss = Loss::kHuber;
  options.noise = NoiseModel{0.1, 0};
  options.per_scan = {Parameter::kMieScattering};
  EXPECT_EQ(likelihood_of(options, reference).link, Link::kLog);
  for (const auto quantity : {refs::Quantity::kLuminance, refs::Quantity::kSpectralRadiance}) {
    reference.quantity = quantity;
    likelihood = likelihood_of(FitOptions{}, reference);
    EXPECT_EQ(likelihood.link, Link::kLinear);
    EXPECT_EQ(likelihood.scale, Scale::kFixed);
    EXPECT_EQ(pointing_of(FitOptions{}, reference), Pointing::kAzimuth);
  }
}

// Directions 40 deg off the principal plane under suns of 20, 40 and 60 deg, relative, turned by -5
// deg: 5 deg of azimuth are missing in what is stated.
refs::Reference turned_relative_sky() {
  constexpr double kOffPlane = 40 * kDegree, kOffset = 5 * kDegree, kNoise = 0.02;
  refs::Reference reference = synthetic_reference(true_atmosphere(1), 0);
  std::erase_if(reference.samples, [](const refs::Sample& sample) { return sample.scan == 0; });
  for (refs::Sample& sample : reference.samples) {
    --sample.scan;
    sample.relative_azimuth += kOffPlane;
  }
  const Dataset data = dataset(reference, refs::standard_spectral_data(), {});
  const Eigen::VectorXd values =
      sky_values(ToySky(), data, start_state(true_atmosphere(1), 3), {}).value;
  std::mt19937 generator(7);
  std::normal_distribution<double> normal(0, kNoise);
  for (std::size_t i = 0; i < data.samples.size(); ++i) {
    refs::Sample& sample = reference.samples[data.samples[i].index];
    sample.value = 1e-4 * (1 + sample.scan) * values(static_cast<Eigen::Index>(i)) *
                   std::exp(normal(generator));
  }
  for (refs::Sample& sample : reference.samples) sample.relative_azimuth -= kOffset;
  return reference;
}

// Loss, pointing, unknowns per scan, profile, bootstrap and hold-outs of a relative luminance.
TEST(SettingsTest, RelativeSkiesHaveEverythingThatMeasuredOnesHave) {
  FitOptions options = determined();
  options.pointing = Pointing::kAzimuth;
  options.per_scan = {Parameter::kGroundAlbedo};
  options.loss = Loss::kHuber;
  options.noise = NoiseModel{0.02, 0};
  const Result result = fit_toy(turned_relative_sky(), options);
  EXPECT_EQ(result.unknowns.size(), 2 + 3 + 3u);
  for (const UnknownRow& row : result.unknowns) {
    const Parameter* parameter = std::get_if<Parameter>(&row.unknown.what);
    const double truth = parameter != nullptr ? get_parameter(true_atmosphere(1), *parameter) : 5.0;
    EXPECT_NEAR(row.fitted, truth, 3 * row.sigma) << row.unknown.name();
  }
  const Checks checks = run_checks(refs::standard_spectral_data(), ToySky(), options, result,
                                   {{"mie.phase.g"}, 30, 0, 1});
  ASSERT_EQ(checks.profiles.size(), 1u);
  const UnknownRow& g = result.unknown("mie.phase.g");
  const Interval& interval = checks.profiles[0].percent68;
  constexpr double kCurved = 0.1;  // the parabola is not exact over three sigmas
  EXPECT_NEAR((interval.upper - interval.lower) / (2 * g.sigma), 1, kCurved);
  ASSERT_TRUE(checks.bootstrap);
  EXPECT_EQ(checks.bootstrap->failed, 0);
  const auto index = static_cast<std::size_t>(&g - result.unknowns.data());
  EXPECT_NEAR(checks.bootstrap->sigma[index] / g.sigma, 1, 0.5);  // known to 13 %; 99 directions
  ASSERT_EQ(checks.hold_outs.size(), 3u);
  for (const HoldOut& held : checks.hold_outs) {
    EXPECT_NEAR(held.pointed.rms_log, 2, 0.7) << held.name;  // the noise, 33 directions
    EXPECT_NEAR(held.pointed.mean_bias, 0, 1) << held.name;  // under its own scale
  }
}

}  // namespace
}  // namespace skyfit::fit
