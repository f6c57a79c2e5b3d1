// SPDX-License-Identifier: Apache-2.0
// Profile likelihood, bootstrap and hold-outs of scans with stated noise agree with the covariance
// and with the noise.
#include "fit/uncertainty/checks.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fit/fit.h"
#include "tests/fit/scans.h"
#include "tests/fit/synthetic.h"

namespace skyfit::fit {
namespace {

class ChecksTest : public testing::Test {
 protected:
  ChecksTest() {
    how.noise = 0.02;
    how.azimuth_offset_deg = {5, 5};
    reference = synthetic_scans(model, true_atmosphere(1), how);
    options.start = power_law_air();
    options.lobes = 1;
    options.use_priors = false;
    options.free = std::vector{Parameter::kMieScattering, Parameter::kMieAngstromExponent,
                               Parameter::kMiePhaseG};
    options.fix = {{Parameter::kRayleighScattering, 1.25e-5},
                   {Parameter::kMieSingleScatteringAlbedo, 0.93},
                   {Parameter::kGroundAlbedo, 0.2}};
    options.noise = NoiseModel{0.02, 0};
    result = fit_atmosphere(reference, spectra, model, options);
  }
  const ToySky model;
  const SpectralData& spectra = refs::standard_spectral_data();
  SyntheticScans how;
  refs::Reference reference;
  FitOptions options;
  Result result;
};

// Near a minimum the likelihood is a parabola whose half width is sigma.
TEST_F(ChecksTest, ProfileIsAsWideAsSigma) {
  const UnknownRow& row = result.unknowns[2];
  const Profile profile = profile_likelihood(spectra, model, options, result, row.unknown.name());
  constexpr double kCurved = 0.05;  // the parabola is not exact over three sigmas
  EXPECT_NEAR((profile.percent68.upper - profile.percent68.lower) / (2 * row.sigma), 1, kCurved);
  EXPECT_NEAR((profile.percent95.upper - profile.percent95.lower) / (2 * 1.96 * row.sigma), 1,
              kCurved);
  EXPECT_EQ(*std::ranges::min_element(profile.chi_square), 0);
}

TEST_F(ChecksTest, ProfileOfNoUnknownListsThem) {
  try {
    profile_likelihood(spectra, model, options, result, "mie.phase.g9");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("fit: mie.phase.g9: not an unknown"));
    EXPECT_THAT(error.what(), testing::HasSubstr("instrument.azimuth_offset[2]"));
  }
}

// 100 repetitions know a standard deviation to 7 %; directions are few (48).
TEST_F(ChecksTest, BootstrapSpreadsAsTheCovarianceSays) {
  const Bootstrap outcome = bootstrap(spectra, model, options, result, 100, 1);
  EXPECT_EQ(outcome.failed, 0);
  for (std::size_t u = 0; u < result.unknowns.size(); ++u) {
    EXPECT_NEAR(outcome.sigma[u] / result.unknowns[u].sigma, 1, 0.4)
        << result.unknowns[u].unknown.name();
    EXPECT_NEAR(outcome.mean[u], result.unknowns[u].fitted, 0.5 * result.unknowns[u].sigma);
  }
  const Bootstrap again = bootstrap(spectra, model, options, result, 3, 7);
  EXPECT_EQ(again.mean, bootstrap(spectra, model, options, result, 3, 7).mean);
}

// What was left out is predicted as well as the noise allows.
TEST_F(ChecksTest, HoldOutsSeeTheNoise) {
  const std::vector<HoldOut> scans = leave_one_scan_out(spectra, model, options, result);
  ASSERT_EQ(scans.size(), 2u);
  for (const HoldOut& held : scans) {
    EXPECT_NEAR(held.predicted.spectral, 2, 0.5) << held.name;
    EXPECT_NEAR(held.pointed.spectral, 2, 0.5) << held.name;
  }
  const std::vector<HoldOut> parts = hold_out_directions(spectra, model, options, result, 3, 1);
  ASSERT_EQ(parts.size(), 3u);
  for (const HoldOut& held : parts) EXPECT_NEAR(held.predicted.spectral, 2, 0.6) << held.name;
}

// Residuals that agree with their neighbours widen sigma, and the profile with it.
TEST_F(ChecksTest, ProfileIsAsWideAsSigmaUnderCorrelation) {
  for (refs::Sample& sample : reference.samples)
    sample.value *= 1 + 0.06 * std::cos(2 * sample.relative_azimuth);
  options.noise.reset();
  const Result correlated = fit_atmosphere(reference, spectra, model, options);
  ASSERT_LT(correlated.effective_samples, 0.5 * correlated.samples);
  const UnknownRow& row = correlated.unknowns[2];
  const Profile profile =
      profile_likelihood(spectra, model, options, correlated, row.unknown.name());
  EXPECT_NEAR((profile.percent68.upper - profile.percent68.lower) / (2 * row.sigma), 1, 0.1);
}

// With priors and unknown noise: what is left out leaves no trace in the share of the priors.
TEST_F(ChecksTest, HoldOutsAreThoseOfAFitOfTheRest) {
  for (refs::Sample& sample : reference.samples) {
    if (sample.scan == 1) sample.value *= 1.5;
  }
  options.noise.reset();
  options.use_priors = true;
  options.pointing = Pointing::kStated;
  options.priors = {{Parameter::kMieScattering, Prior{2e-4, 4e-5}}};
  const std::vector<HoldOut> held = leave_one_scan_out(
      spectra, model, options, fit_atmosphere(reference, spectra, model, options));
  const auto of_scan = [&](int scan) {
    refs::Reference kept = reference;
    for (refs::Sample& sample : kept.samples) {
      if (sample.scan != scan) sample.weight = 0;
    }
    return kept;
  };
  const Result first = fit_atmosphere(of_scan(0), spectra, model, options);
  const double alone = errors_of(of_scan(1), first.model, spectra).spectral;
  // The factors on sigma agree within 5 %, the rule of fit.cc.
  EXPECT_NEAR(held[1].predicted.spectral / alone, 1, 0.01);
}

// A direction that an obstruction darkens, and a reading that is there twice.
TEST_F(ChecksTest, SamplesThatNoNoiseExplainsAndRepeatedOnesAreNoted) {
  EXPECT_THAT(result.reference.notes, testing::IsEmpty());
  reference.samples[40].value *= 0.6;
  reference.samples.push_back(reference.samples[7]);
  const Result noted = fit_atmosphere(reference, spectra, model, options);
  EXPECT_THAT(noted.reference.notes,
              testing::UnorderedElementsAre(
                  testing::HasSubstr("1 of 193 samples repeat the direction, wavelength and value"),
                  testing::AllOf(testing::HasSubstr("more than 8 times as far off"),
                                 testing::HasSubstr("zenith 45 deg"))));
}

}  // namespace
}  // namespace skyfit::fit
