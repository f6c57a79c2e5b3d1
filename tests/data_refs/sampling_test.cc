// SPDX-License-Identifier: Apache-2.0
// The samplings have the counts, angles and solid angles of their definitions.
#include "data_refs/sampling.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>

namespace skyfit::refs {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDegree = kPi / 180;
constexpr double kRounding = 1e-12;

TEST(PrincipalPlane, Has35DirectionsWithOneZenith) {
  const std::vector<SkyDirection> directions = principal_plane_directions();
  ASSERT_EQ(directions.size(), 35u);
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const double deg = -85.0 + 5.0 * static_cast<double>(i);
    EXPECT_NEAR(directions[i].view_zenith, std::abs(deg) * kDegree, kRounding);
    EXPECT_EQ(directions[i].relative_azimuth, deg < 0 ? kPi : 0.0);
  }
}

TEST(Tregenza, RowsHaveTheirAltitudesAndCounts) {
  const std::vector<TregenzaPatch> patches = tregenza_patches();
  EXPECT_EQ(patches.size(), 145u);
  std::map<long, int> count_of_altitude;
  for (const TregenzaPatch& patch : patches) {
    ++count_of_altitude[std::lround(90 - patch.centre.view_zenith / kDegree)];
  }
  const std::map<long, int> expected = {{6, 30},  {18, 30}, {30, 24}, {42, 24},
                                        {54, 18}, {66, 12}, {78, 6},  {90, 1}};
  EXPECT_EQ(count_of_altitude, expected);
}

TEST(Tregenza, SolidAnglesFillTheHemisphereNearlyEvenly) {
  double sum = 0, horizontal = 0;
  for (const TregenzaPatch& patch : tregenza_patches()) {
    sum += patch.solid_angle_sr;
    horizontal += patch.solid_angle_sr * std::cos(patch.centre.view_zenith);
    // The counts were chosen for patches of about the mean size; the zenith's cap is the smallest
    // by a fifth.
    EXPECT_NEAR(patch.solid_angle_sr / (2 * kPi / 145), 1, 0.21);
  }
  EXPECT_NEAR(sum, 2 * kPi, kRounding);
  // Under a uniform sky the rows to altitude 84 deg give pi sin^2(84 deg); the cosine at a row's
  // centre instead of over its height d is 1 / cos(d / 2) too much. The cap's centre has cosine 1.
  const double cap = std::sin(84 * kDegree);
  EXPECT_NEAR(horizontal, kPi * cap * cap / std::cos(6 * kDegree) + 2 * kPi * (1 - cap), kRounding);
}

TEST(Tregenza, RowsStartAtTheSunAndAreEvenlySpaced) {
  const std::vector<TregenzaPatch> patches = tregenza_patches();
  EXPECT_EQ(patches[0].centre.relative_azimuth, 0);
  EXPECT_NEAR(patches[1].centre.relative_azimuth, 12 * kDegree, kRounding);
  EXPECT_NEAR(patches[29].centre.relative_azimuth, 348 * kDegree, kRounding);
  EXPECT_EQ(patches[30].centre.relative_azimuth, 0);
}

}  // namespace
}  // namespace skyfit::refs
