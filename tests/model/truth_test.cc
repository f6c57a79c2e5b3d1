// SPDX-License-Identifier: Apache-2.0
// The reference model agrees with Monte Carlo (spherical) and discrete ordinates (plane-parallel
// limit).
#include "tests/model/truth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

namespace skyfit::truth {
namespace {

constexpr double kWorst = 0.03;  // of any value with sun <= 80 and view <= 85 deg
constexpr double kRms = 0.01;    // over those values
constexpr double kEdge = 1e-9;   // rad, so that a limit in degrees includes its own angle

bool by_day(const SkyPoint& p) {
  return p.sun_zenith < 80 * kDegree + kEdge && p.view_zenith < 85 * kDegree + kEdge;
}

void expect_true(const std::string& name, const std::vector<Compared>& rows) {
  const Errors day = errors(rows, by_day);
  std::cout << name << ": " << day.count << " values by day, rms " << 100 * day.rms << " %, worst "
            << day.where << "\n";
  ASSERT_GT(day.count, 50);
  EXPECT_LT(day.worst, kWorst) << day.where;
  EXPECT_LT(day.rms, kRms);
  const Errors all = errors(rows, [](const SkyPoint&) { return true; });
  std::cout << name << ": all " << all.count << " values, rms " << 100 * all.rms << " %, worst "
            << all.where << "\n";
}

TEST(Truth, ClearEarthFromTheGround) {
  expect_true("clear", compare_monte_carlo(*make_sky_model("reference", 2), false));
}

TEST(Truth, HazyEarthFromTheGround) {
  expect_true("haze", compare_monte_carlo(*make_sky_model("reference", 2), true));
}

TEST(Truth, PlaneParallelLimit) {
  for (const char* name : {"R1", "R3", "A3"})
    expect_true(name, compare_plane_parallel(*make_sky_model("reference", 2), name));
}

}  // namespace
}  // namespace skyfit::truth
