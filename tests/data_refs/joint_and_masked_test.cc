// SPDX-License-Identifier: Apache-2.0
// References join with their scans numbered on; absorption bands lose their weight and say why; the
// shipped grounds are shapes that are 1 at 550 nm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data_refs/absorption_bands.h"
#include "data_refs/ground_spectra.h"
#include "data_refs/joint_reference.h"

namespace skyfit::refs {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

Reference two_scans(const std::string& name) {
  Reference reference;
  reference.name = name;
  reference.quantity = Quantity::kSpectralRadiance;
  for (const int scan : {0, 1}) {
    for (const double nm : {680.0, 690.0, 725.0, 760.0}) {
      Sample sample;
      sample.scan = scan;
      sample.wavelength_nm = nm;
      sample.value = 0.1;
      reference.samples.push_back(sample);
    }
    Scan facts;
    facts.name = name + std::to_string(scan);
    reference.scans.push_back(facts);
  }
  return reference;
}

TEST(JointReferenceTest, ScansAreNumberedOn) {
  const Reference joint = joint_reference({two_scans("a"), two_scans("b")});
  EXPECT_EQ(joint.name, "a and 1 more");
  EXPECT_EQ(joint.samples.size(), 16u);
  EXPECT_EQ(joint.samples[8].scan, 2);
  EXPECT_EQ(joint.samples[15].scan, 3);
  ASSERT_EQ(joint.scans.size(), 4u);
  EXPECT_EQ(joint.scans[3].name, "b1");
}

TEST(JointReferenceTest, RefusesDifferentQuantities) {
  Reference luminance = two_scans("b");
  luminance.quantity = Quantity::kLuminance;
  EXPECT_THAT(
      [&] {
        joint_reference({two_scans("a"), luminance});
      },
      ThrowsMessage<std::invalid_argument>(
          HasSubstr("b: luminance: expected spectral radiance as in a")));
  EXPECT_THROW(joint_reference({}), std::invalid_argument);
}

TEST(AbsorptionBandsTest, MaskedSamplesSayWhy) {
  Reference reference = two_scans("a");
  reference.samples[3].weight = 0;
  reference.samples[3].zero_weight_reason = "saturated";
  EXPECT_EQ(mask_absorption_bands(reference), 5);
  EXPECT_EQ(reference.samples[0].weight, 1);
  EXPECT_THAT(reference.samples[1].zero_weight_reason, HasSubstr("oxygen B"));
  EXPECT_THAT(reference.samples[2].zero_weight_reason, HasSubstr("water"));
  EXPECT_EQ(reference.samples[3].zero_weight_reason, "saturated");
}

TEST(GroundSpectraTest, ShippedShapesAreOneAt550) {
  EXPECT_THAT(ground_names(), testing::ElementsAre("flat", "grass", "sand", "snow"));
  EXPECT_EQ(ground_spectrum("flat"), nullptr);
  for (const char* name : {"grass", "sand", "snow"})
    EXPECT_DOUBLE_EQ(ground_spectrum(name)->at(550), 1) << name;
  EXPECT_GT(ground_spectrum("grass")->at(780), 4);  // the red edge
  EXPECT_LT(ground_spectrum("grass")->at(675), 0.6);
  EXPECT_NEAR(ground_spectrum("snow")->at(400), 1, 0.05);
  EXPECT_THAT([] { ground_spectrum("lawn"); },
              ThrowsMessage<std::invalid_argument>(
                  HasSubstr("ground \"lawn\": no such file, expected one of flat, grass")));
}

}  // namespace
}  // namespace skyfit::refs
