// SPDX-License-Identifier: Apache-2.0
// The light of a sky tells where the sun is, and which change of clock, place or azimuths would
// bring the stated one there.
#include "data_refs/seen_sun.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "data_refs/measured_formats.h"
#include "data_refs/measured_sky.h"
#include "data_refs/references.h"
#include "data_refs/sky_image.h"
#include "data_refs/solar_position.h"
#include "data_refs/sun_check.h"
#include "model/base/input_file.h"
#include "model/base/temporary_directory.h"
#include "model/base/whole_file.h"
#include "model/geometry/map_projection.h"
#include "model/numerics/angles.h"
#include "tests/data_refs/complaint.h"

namespace skyfit::refs {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

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

// Three scans under different suns, the azimuths of the first `wrong` of them turned by 40 deg.
Reference three_scans(int wrong) {
  const std::vector<double> suns = {30 * kDegree, 50 * kDegree, 70 * kDegree};
  Reference sky = load_reference("cie:12", suns, Sampling::kTregenza, {});
  sky.scans.resize(suns.size());
  for (Sample& s : sky.samples) {
    s.scan = static_cast<int>(std::ranges::find(suns, s.sun_zenith) - suns.begin());
    if (s.scan < wrong) s.relative_azimuth += 40 * kDegree;
  }
  return sky;
}

TEST(SunCheck, AScanWithAnotherSunIsLeftOutAndSaid) {
  Reference sky = three_scans(1);
  check_suns({}, sky);
  for (const Sample& s : sky.samples) {
    EXPECT_EQ(s.weight > 0, s.scan != 0);
    EXPECT_EQ(s.zero_weight_reason, s.scan != 0 ? "" : "the light puts the sun elsewhere");
  }
  EXPECT_THAT(sky.notes,
              ElementsAre(AllOf(StartsWith("a scan is left out: "), HasSubstr("turned 40.0 deg"),
                                HasSubstr("--accept-sun"))));
  Reference most = three_scans(2);
  EXPECT_THAT(complaint_of([&] { check_suns({}, most); }), HasSubstr("the light of the sky puts"));
  ImportOptions options;
  options.accept_sun = true;
  Reference accepted = three_scans(2);
  check_suns(options, accepted);
  EXPECT_EQ(accepted.notes.size(), 2u);
  EXPECT_TRUE(std::ranges::all_of(accepted.samples, [](const Sample& s) { return s.weight > 0; }));
}

// A light probe over a bright ground, read as if it were a fisheye image: no sun fits its light
// well, yet the stated one, far from what is brightest, is not there.
TEST(SunCheck, AnotherProjectionIsRefused) {
  constexpr int kSide = 200;
  const auto probe = make_map_projection("angular", kSide);
  const double sun_zenith = 40 * kDegree, sun_azimuth = 140 * kDegree;
  const Axis sun = {std::sin(sun_zenith) * std::sin(sun_azimuth),
                    std::sin(sun_zenith) * std::cos(sun_azimuth), std::cos(sun_zenith)};
  Image image{kSide, kSide, {"Y"}, {}};
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const Axis d = probe->direction(x + 0.5, y + 0.5).value_or(Axis{0, 0, -1});
      const double cosine = d[0] * sun[0] + d[1] * sun[1] + d[2] * sun[2];
      // CIE S 011, type 12
      const double sky = (1 - std::exp(-0.32 / std::max(d[2], 0.01))) *
                         (1 + 10 * std::exp(-3 * std::acos(std::clamp(cosine, -1.0, 1.0))) +
                          0.45 * cosine * cosine);
      image.pixels.push_back(static_cast<float>(d[2] > 0 ? sky : 1));
    }
  }
  ImportOptions facts;
  facts.unit = "relative";
  facts.sun_zenith_deg = 40;
  facts.sun_azimuth_deg = 140;
  const auto complaint = [&](const std::string& projection) {
    facts.projection = projection;
    Reference sky = sky_image_reference(image, nullptr, false, "sky.exr", facts);
    return complaint_of([&] { check_suns(facts, sky); });
  };
  EXPECT_EQ(complaint("angular"), "accepted");
  for (const char* lens : {"equidistant", "equisolid", "orthographic"})
    EXPECT_THAT(complaint(lens), HasSubstr("the light of the sky puts the sun")) << lens;
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
