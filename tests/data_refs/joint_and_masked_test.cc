// SPDX-License-Identifier: Apache-2.0
// References join with their scans numbered on; absorption bands lose their weight and say why; the
// shipped grounds are shapes that are 1 at 550 nm.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "data_refs/absorption_bands.h"
#include "data_refs/ground_spectra.h"
#include "data_refs/irradiance.h"
#include "data_refs/joint_reference.h"
#include "model/numerics/angles.h"

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
  EXPECT_TRUE(is_joint_name(joint.name));
  EXPECT_FALSE(is_joint_name(joint_reference({two_scans("a")}).name));
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

// Two scans of the times given, under suns of 40 and 50 deg.
Reference sky_of(const std::string& first, const std::string& second) {
  Reference sky = two_scans("sky");
  for (Sample& sample : sky.samples)
    sample.sun_zenith = (sample.scan == 0 ? 40 : 50) * kRadiansPerDegree;
  sky.scans[0].time_utc = first;
  sky.scans[1].time_utc = second;
  return sky;
}

Reference illuminance(double sun_deg, const std::string& time) {
  Reference reference = irradiance_reference("direct=80000lx", sun_deg * kRadiansPerDegree, {});
  reference.scans[0].time_utc = time;
  return reference;
}

constexpr const char *kMorning = "2024-05-15T08:00:00Z", *kNoon = "2024-05-15T11:00:00Z",
                     *kEvening = "2024-05-15T17:00:00Z";

TEST(JointReferenceTest, IrradiancesBelongToTheScanOfTheirMinuteOrToOneOfTheirSun) {
  const Reference sky = sky_of(kMorning, kNoon);
  const auto scan = [&](const Reference& irradiances) {
    const Reference joint = with_irradiances(sky, irradiances);
    EXPECT_EQ(joint.name, "sky");
    EXPECT_EQ(joint.quantity, Quantity::kSpectralRadiance);
    EXPECT_EQ(joint.irradiance_quantity, Quantity::kIlluminance);
    EXPECT_EQ(joint.samples.size(), 9u);
    EXPECT_TRUE(is_beside_sky(joint, joint.samples.back()));
    EXPECT_FALSE(is_beside_sky(joint, joint.samples.front()));
    return joint.samples.back().scan;
  };
  EXPECT_EQ(scan(illuminance(50.9, "")), 1);
  EXPECT_EQ(scan(illuminance(40.9, kMorning)), 0);
  EXPECT_EQ(scan(illuminance(40, "2024-05-15T08:01:00Z")), 0);
  EXPECT_EQ(scan(illuminance(40, "2024-05-15T08:01:01Z")), 2);
  EXPECT_EQ(scan(illuminance(75, kEvening)), 2);
  const Reference two = with_irradiances(sky, illuminance(75, kEvening));
  ASSERT_EQ(two.scans.size(), 3u);
  EXPECT_EQ(two.scans[2].time_utc, kEvening);
  EXPECT_EQ(with_irradiances_of_scans(sky, illuminance(50, kNoon)).samples.back().scan, 1);
}

TEST(JointReferenceTest, RefusesIrradiancesThatContradictTheSky) {
  const Reference sky = sky_of(kMorning, kNoon);
  const auto complaint = [&](const auto& join, const Reference& of, const Reference& irradiances) {
    try {
      join(of, irradiances);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint(with_irradiances, sky, illuminance(42, kMorning)),
            "irradiances: 2024-05-15T08:00:00Z: the sun of sky0 is 40 deg from the zenith, that of "
            "the irradiances 42 at the same time: expected within 1 deg");
  EXPECT_EQ(complaint(with_irradiances, sky, illuminance(75, "")),
            "irradiances: the sun of sky1 is 50 deg from the zenith, that of the irradiances 75: "
            "expected within 1 deg of a scan, or the time of both");
  EXPECT_EQ(complaint(with_irradiances_of_scans, sky, illuminance(75, kEvening)),
            "irradiances: no irradiances are of the minute of a scan of sky: expected those of "
            "each scan's time");
  EXPECT_EQ(complaint(with_irradiances, illuminance(40, ""), illuminance(40, "")),
            "irradiances: illuminance: expected a sky beside irradiances");
  EXPECT_EQ(complaint(with_irradiances, sky, sky),
            "sky: spectral radiance: expected irradiances beside a sky");
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
