// SPDX-License-Identifier: Apache-2.0
// The sun's position is the published one: the worked example of Reda & Andreas 2004, an example of
// Meeus, and properties that hold for every place.
#include "data_refs/solar_position.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace skyfit::refs {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr double kShortNutation = 0.0005;  // deg: four terms of nutation, TT - UT by the decade
constexpr double kClaimed = 0.01;          // deg

// Reda & Andreas 2004, table A5.1 of the report NREL/TP-560-34302: 17 October 2003, 12:30:30 at
// UTC-7, Golden. Their topocentric elevation angle without refraction is 39.872046 deg.
TEST(SolarPosition, IsThatOfRedaAndAndreas) {
  const SolarPosition sun = solar_position(*instant("2003-10-17", "12:30:30", -7),
                                           {39.742476 * kDegree, -105.1786 * kDegree, 1830.14});
  EXPECT_NEAR(sun.zenith / kDegree, 90 - 39.872046, kShortNutation);
  EXPECT_NEAR(sun.azimuth / kDegree, 194.340241, kShortNutation);
  EXPECT_NEAR(sun.distance_au, 0.9965422974, 1e-7);
}

// Meeus, Astronomical Algorithms, example 25.b: 13 October 1992, 0 h TD; apparent declination
// -7 deg 47' 01.74", distance 0.99760775 au. Seen from the pole the sun stands at its declination.
TEST(SolarPosition, IsThatOfMeeus) {
  const Instant time = *instant("1992-10-12", "23:59:00.9", 0);  // TT - UT was 59.1 s
  const SolarPosition sun = solar_position(time, {90 * kDegree, 0, 0});
  const double parallax = 8.8 / 3600;  // of a sun near the horizon
  EXPECT_NEAR(90 - sun.zenith / kDegree, -(7 + 47.0 / 60 + 1.74 / 3600) - parallax, kShortNutation);
  EXPECT_NEAR(sun_distance_au(time), 0.99760775, 1e-7);
}

// At perihelion and aphelion 2020 (Astronomical Almanac).
TEST(SunDistance, HasItsExtremes) {
  EXPECT_NEAR(sun_distance_au(*instant("2020-01-05", "07:48", 0)), 0.983244, 2e-6);
  EXPECT_NEAR(sun_distance_au(*instant("2020-07-04", "11:35", 0)), 1.016694, 2e-6);
}

// June solstice 2024 at 20:51 UT: the declination is the obliquity, 23.4382 deg, and on that
// parallel the sun culminates in the zenith.
TEST(SolarPosition, StandsInTheZenithOfTheTropicAtNoonOfTheSolstice) {
  const Instant time = *instant("2024-06-20", "20:51", 0);
  double smallest = 180;
  for (double longitude = -180; longitude < 180; longitude += 0.01) {
    smallest = std::min(smallest,
                        solar_position(time, {23.4382 * kDegree, longitude * kDegree, 0}).zenith);
  }
  EXPECT_LT(smallest / kDegree, kClaimed);
}

// Noon is 3 min before 12 h on that day (equation of time), the declination 21.3 deg.
TEST(SolarPosition, MovesFromEastOverSouthToWestInTheNorth) {
  const Site site{42 * kDegree, 0, 0};
  double last = 0;
  for (int hour = 6; hour <= 18; ++hour) {
    const double azimuth =
        solar_position(*instant("2013-05-27", std::to_string(hour) + ":00", 0), site).azimuth;
    EXPECT_GT(azimuth, last);
    last = azimuth;
  }
  const SolarPosition noon = solar_position(*instant("2013-05-27", "11:57", 0), site);
  EXPECT_NEAR(noon.azimuth / kDegree, 180, 0.5);
  EXPECT_NEAR(noon.zenith / kDegree, 42 - 21.3, 0.2);
}

TEST(CivilTime, IsReadWithItsOffset) {
  EXPECT_EQ(iso_text(*instant("2013-05-27T09:30:00", -4)), "2013-05-27T13:30:00Z");
  EXPECT_EQ(iso_text(*instant("2013/12/31 23:45", -0.5)), "2014-01-01T00:15:00Z");
  EXPECT_EQ(iso_text(*instant("2012-02-29", "00:10:30.7", 9)), "2012-02-28T15:10:30Z");
  EXPECT_EQ(iso_text(*instant("2013-05-27", "09.30.38", 0)), "2013-05-27T09:30:38Z");
  for (const char* wrong : {"2013-02-30T09:30", "2013-05-27T24:00", "2013-05-27",
                            "27.05.2013 09:30", "2013-05-27T09:60", "2013-13-01T00:00", ""}) {
    EXPECT_FALSE(instant(wrong, 0)) << wrong;
  }
}

}  // namespace
}  // namespace skyfit::refs
