// SPDX-License-Identifier: Apache-2.0
// Scans as people have them: a hemisphere as a letter, a scan at night among others, a sky without
// a bright side, a refracted sun, a time with its offset.
#include <gmock/gmock.h>

#include <numbers>
#include <string>

#include "complaint.h"
#include "data_refs/measured_formats.h"
#include "data_refs/measured_sky.h"
#include "data_refs/solar_position.h"

namespace skyfit::refs {
namespace {

using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180;

Reference load(const std::string& name) {
  return load_measured_sky(std::string(SKYFIT_TEST_DATA) + "/" + name, {});
}

TEST(FoundFiles, HemisphereLettersAreSigns) {
  const Reference sky = load("eko_equinox_S.csv");  // 9:20 in March at 33.5 S, 151.2 E
  EXPECT_NEAR(*sky.scans.front().sun_azimuth / kDegree, 57.1, 0.1);  // of the north-east
}

TEST(FoundFiles, AScanAtNightIsLeftOutAndSaid) {
  const Reference sky = load("eko_with_night.csv");
  EXPECT_EQ(sky.scans.size(), 1u);
  ASSERT_EQ(sky.notes.size(), 3u);
  EXPECT_THAT(sky.notes[1], HasSubstr("a scan is left out"));
  EXPECT_THAT(sky.notes[1], HasSubstr("expected a sun above the horizon"));
}

TEST(FoundFiles, TheFilesAzimuthOfTheSunSettlesAnOvercastSky) {
  EXPECT_THAT(load("eko_overcast.csv").notes.front(),
              HasSubstr("azimuth_zero is south: the file's azimuth of the sun is 0.0 deg"));
}

TEST(FoundFiles, AnApparentSunIsAcceptedAndTheTrueOneUsed) {
  const Reference sky = load("apparent_sun.csv");
  EXPECT_THAT(sky.notes.front(), HasSubstr("is the apparent sun"));
  EXPECT_NEAR(sky.samples.front().sun_zenith / kDegree, 88.438, 1e-3);
}

// Saemundsson's formula has 0.5 arc minutes at altitude 60 deg and 29 at the horizon.
TEST(FoundFiles, RefractionIsTheAlmanacs) {
  EXPECT_NEAR(refraction(30 * kDegree) / kDegree * 60, 0.59, 0.02);
  EXPECT_NEAR(refraction(90 * kDegree) / kDegree * 60, 28.98, 0.1);
  EXPECT_EQ(refraction(100 * kDegree), 0);
}

TEST(FoundFiles, TimesMayStateTheirOffset) {
  EXPECT_EQ(stated_utc_offset_h("2024-05-15T09:30:00Z"), 0);
  EXPECT_EQ(stated_utc_offset_h("2024-05-15 09:30+05:30"), 5.5);
  EXPECT_EQ(stated_utc_offset_h("2024-05-15T09:30:00-0330"), -3.5);
  EXPECT_FALSE(stated_utc_offset_h("2024-05-15T09:30:00").has_value());
  for (const char* wrong :
       {"2024-05-15T09:30:00+09:75", "2024-05-15T09:30:00+99:00", "2024-05-15T09:30:00-14:30"}) {
    EXPECT_FALSE(instant(wrong, 0).has_value()) << wrong;
  }
  ImportOptions facts;
  facts.local_time = "2024-05-15T14:00:00+02:00";
  facts.latitude_deg = 47;
  facts.longitude_deg = 11;
  EXPECT_EQ(iso_text(*sun_of_scan(facts, "sky.csv").time), "2024-05-15T12:00:00Z");
  facts.utc_offset_h = 1;
  EXPECT_EQ(
      complaint_of([&] { sun_of_scan(facts, "sky.csv"); }),
      "sky.csv: utc_offset_h = 1: expected 2, as local_time = 2024-05-15T14:00:00+02:00 says");
}

}  // namespace
}  // namespace skyfit::refs
