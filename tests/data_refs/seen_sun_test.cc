// SPDX-License-Identifier: Apache-2.0
// The light of a sky tells where the sun is, and which change of clock, place or azimuths would
// bring the stated one there.
#include "data_refs/seen_sun.h"

#include <gmock/gmock.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <string>

#include "data_refs/measured_formats.h"
#include "data_refs/measured_sky.h"
#include "data_refs/references.h"
#include "data_refs/solar_position.h"
#include "data_refs/sun_check.h"
#include "model/base/input_file.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"
#include "model/numerics/angles.h"
#include "tests/data_refs/complaint.h"

namespace skyfit::refs {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double kDegree = kRadiansPerDegree;

// Standard skies whose stated sun is 10 deg too high and whose azimuths are turned by 40 deg.
TEST(SeenSun, IsFoundWhereItIsNotStated) {
  for (const char* name :
       {"cie:2", "cie:4", "cie:7", "cie:10", "cie:12", "cie:15", "perez:6,0.12"}) {
    for (const double zenith : {30.0, 55.0, 75.0}) {
      Reference sky = load_reference(name, {zenith * kDegree}, Sampling::kTregenza, {});
      for (Sample& s : sky.samples) {
        s.sun_zenith -= 10 * kDegree;
        s.relative_azimuth += 40 * kDegree;
      }
      const auto seen = seen_sun(sky.samples);
      ASSERT_TRUE(seen) << name;
      EXPECT_NEAR(seen->zenith / kDegree, zenith, 1) << name;
      EXPECT_NEAR(seen->relative_azimuth / kDegree, 40, 1) << name << " " << zenith;
      EXPECT_LT(seen->sigma, 1 * kDegree);
    }
  }
}

TEST(SeenSun, IsNotSeenUnderCloudsNorInAFewDirections) {
  for (const char* name : {"cie:1", "cie:3", "cie:5"}) {
    const auto seen =
        seen_sun(load_reference(name, {50 * kDegree}, Sampling::kTregenza, {}).samples);
    EXPECT_TRUE(!seen || seen->sigma > 10 * kDegree) << name;
  }
  EXPECT_FALSE(
      seen_sun(load_reference("cie:12", {50 * kDegree}, Sampling::kPrincipalPlane, {}).samples));
}

// The example of 145 patches with something changed in its head.
class WrongSun : public ::testing::Test {
 protected:
  Reference load(const std::string& from, const std::string& to, ImportOptions options = {}) const {
    std::string text = read_file(SKYFIT_EXAMPLES "sky_scan_145.csv", "the example", 1 << 20);
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    const auto file = directory_.path() / "scan.csv";
    write_whole_file(file, text);
    return load_measured_sky(file, options);
  }

  TemporaryDirectory directory_;
};

TEST_F(WrongSun, IsRefusedWithWhatWouldMendIt) {
  EXPECT_THAT(complaint_of([&] { load("longitude_deg=11.0", "longitude_deg=-11.0"); }),
              AllOf(HasSubstr("scan.csv: the light of the sky puts the sun 20.8 deg from"),
                    HasSubstr("mended by longitude_deg = 11 "), HasSubstr("--accept-sun")));
  EXPECT_THAT(complaint_of([&] { load("utc_offset_h=2", "utc_offset_h=1"); }),
              HasSubstr("mended by a clock that is 1 h fast (utc_offset_h 1 more)"));
  EXPECT_THAT(complaint_of([&] { load("latitude_deg=47.5", "latitude_deg=-47.5"); }),
              HasSubstr("mended by latitude_deg = 47.5"));
}

// Where the zero of azimuths is open and none fits, a mend names the zero that goes with it.
TEST_F(WrongSun, IsSeenWithEitherZeroOfAzimuths) {
  EXPECT_THAT(complaint_of([&] {
                load(
                    "azimuth_zero=north local_time=2024-05-15T15:00:00 utc_offset_h=2 "
                    "latitude_deg=47.5 longitude_deg=11.0",
                    "local_time=2024-05-15T15:00:00 utc_offset_h=2 latitude_deg=-47.5 "
                    "longitude_deg=11.0");
              }),
              AllOf(HasSubstr("azimuth_zero: not stated"),
                    HasSubstr("mended by latitude_deg = 47.5 with azimuth_zero north (leaves 0.")));
}

// A stated sun tells the mend as the light does; 47.5 N, 11 E has its sun there at that time.
TEST(StatedSun, TellsWhatWouldMendThePlace) {
  const auto site = [](double latitude_deg, double longitude_deg) {
    return Site{latitude_deg * kDegree, longitude_deg * kDegree};
  };
  const Instant time = *instant("2024-05-15T06:30:00", 0);
  const SolarPosition sun = solar_position(time, site(47.5, 11));
  const auto complaint = [&](double latitude_deg, double longitude_deg, int hours) {
    ImportOptions facts;
    facts.local_time = iso_text(time + std::chrono::hours(hours));
    facts.latitude_deg = latitude_deg;
    facts.longitude_deg = longitude_deg;
    facts.sun_zenith_deg = sun.zenith / kDegree;
    return complaint_of([&] { sun_of_scan(facts, "scan.csv"); });
  };
  EXPECT_EQ(complaint(47.5, 11, 0), "accepted");
  EXPECT_THAT(complaint(47.5, -11, 0), HasSubstr("mended by longitude_deg = 11 (leaves 0.0 deg)"));
  EXPECT_THAT(complaint(11, 47.5, 0),
              HasSubstr("mended by latitude and longitude exchanged (latitude_deg = 47.5, "
                        "longitude_deg = 11) (leaves 0.0 deg)"));
  EXPECT_THAT(complaint(47.5, 11, 1),
              HasSubstr("mended by a clock that is 1 h fast (utc_offset_h 1 more)"));
  EXPECT_THAT(complaint(85, 100, 0), HasSubstr("no single change of time, place or azimuths"));
}

TEST_F(WrongSun, IsAcceptedWhenAskedFor) {
  ImportOptions options;
  options.accept_sun = true;
  EXPECT_THAT(load("utc_offset_h=2", "utc_offset_h=1", options).notes,
              ::testing::Contains(HasSubstr("1 h fast")));
}

TEST_F(WrongSun, ByMinutesIsNoted) {
  EXPECT_THAT(load("T15:00:00", "T15:12:00").notes,
              ::testing::Contains(HasSubstr("mended by a clock that is 12 min fast")));
  EXPECT_THAT(load("T15:00:00", "T15:00:30").notes, IsEmpty());
}

}  // namespace
}  // namespace skyfit::refs
