// SPDX-License-Identifier: Apache-2.0
// A CIE sky is recognised as its own type with no residual, under noise too, turned or not; the
// free fit returns coefficients that describe it.
#include "fit/classify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "data_refs/references.h"
#include "data_refs/spectra.h"

namespace skyfit::fit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

refs::Reference cie(int type) {
  return refs::load_reference("cie:" + std::to_string(type), {30 * kDegree, 60 * kDegree},
                              refs::Sampling::kTregenza);
}

class ClassifyTest : public testing::TestWithParam<int> {};

TEST_P(ClassifyTest, TypeIsItself) {
  const Classification found = classify(cie(GetParam()), refs::standard_spectral_data(), {});
  EXPECT_EQ(found.nearest().sky.type, GetParam());
  EXPECT_LT(found.nearest().rms_log_percent, 1e-9);
  EXPECT_EQ(found.nearest_of_scan(1), GetParam());
  EXPECT_EQ(found.types.size(), 15u);
  EXPECT_LT(found.free.rms_log_percent, 0.5);
  EXPECT_EQ(found.free.sky.type, 0);
}

INSTANTIATE_TEST_SUITE_P(Types, ClassifyTest, testing::Values(1, 5, 8, 12, 15));

// Azimuths that are off by 12 deg are found when they are free.
TEST(ClassifyTest, AzimuthOffsetIsFound) {
  refs::Reference turned = cie(12);
  for (refs::Sample& sample : turned.samples) sample.relative_azimuth -= 12 * kDegree;
  ClassifyOptions options;
  EXPECT_GT(classify(turned, refs::standard_spectral_data(), options).nearest().rms_log_percent, 3);
  options.free_azimuth = true;
  const Classification found = classify(turned, refs::standard_spectral_data(), options);
  EXPECT_EQ(found.nearest().sky.type, 12);
  EXPECT_NEAR(found.nearest().azimuth_offset[0], 12 * kDegree, 1e-3);
  EXPECT_LT(found.nearest().rms_log_percent, 0.01);
}

// Coefficients between two types: the free fit is nearer than every type.
TEST(ClassifyTest, FreeFitDescribesASkyBetweenTheTypes) {
  refs::Reference between = cie(12);
  const refs::Reference other = cie(13);
  for (std::size_t i = 0; i < between.samples.size(); ++i)
    between.samples[i].value = std::sqrt(between.samples[i].value * other.samples[i].value);
  const Classification found = classify(between, refs::standard_spectral_data(), {});
  EXPECT_LT(found.free.rms_log_percent, 0.2 * found.nearest().rms_log_percent);
  EXPECT_THAT(classification_text(found), testing::HasSubstr("<- nearest"));
  EXPECT_EQ(classification_json(found)["types"].size(), 15u);
}

// Radiances of CIE 12 at some wavelengths.
refs::Reference spectral(const std::vector<double>& wavelengths_nm) {
  refs::Reference reference = cie(12);
  const std::vector<refs::Sample> samples = std::move(reference.samples);
  reference.quantity = refs::Quantity::kSpectralRadiance;
  reference.samples.clear();
  for (refs::Sample s : samples) {
    for (const double wavelength : wavelengths_nm) {
      s.wavelength_nm = wavelength;
      reference.samples.push_back(s);
    }
  }
  return reference;
}

TEST(ClassifyTest, AFewWavelengthsAreNoLuminance) {
  EXPECT_THAT(
      [] {
        classify(spectral({440, 675, 870}), refs::standard_spectral_data(), {});
      },
      testing::ThrowsMessage<std::invalid_argument>(testing::HasSubstr("no luminance")));
  EXPECT_FALSE(refs::gives_luminance(spectral({550})));
  EXPECT_FALSE(refs::gives_luminance(spectral({440, 500, 540, 580, 620, 660})));
  const refs::Reference many = spectral({400, 440, 480, 520, 560, 600, 640, 680});
  EXPECT_TRUE(refs::gives_luminance(many));
  EXPECT_EQ(classify(many, refs::standard_spectral_data(), {}).nearest().sky.type, 12);
}

}  // namespace
}  // namespace skyfit::fit
