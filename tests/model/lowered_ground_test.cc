// SPDX-License-Identifier: Apache-2.0
// The air of a basin: nothing changes above the datum, exponential profiles go on below it, and the
// amounts of those that end above it are the same.
#include "model/atmosphere/lowered_ground.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "model/atmosphere/derived.h"
#include "model/atmosphere/profile.h"

namespace skyfit {
namespace {

constexpr double kDepth = 4000, kWavelength = 550, kOzone = 3e-25;

Constituent<double> named(const char* name, AmountType type, double amount) {
  Constituent<double> c;
  c.name = name;
  c.amount_type = type;
  c.amount = amount;
  return c;
}

// Every kind of profile and amount.
Atmosphere<double> every_kind() {
  Atmosphere<double> a;
  Constituent<double> layer = named("layer", AmountType::kOpticalDepth, 0.2);
  layer.profile.type = ProfileType::kLayer;
  layer.profile.base_m = 3000;
  layer.profile.top_m = 5000;
  Constituent<double> haze = named("haze", AmountType::kOpticalDepth, 0.1);
  haze.profile.scale_height_m = 2000;
  Constituent<double> table = named("table", AmountType::kExtinction, 1e-5);
  table.profile.type = ProfileType::kTabulated;
  table.profile.table =
      std::make_shared<const LinearProfile>(TwoColumns{{0, 1000, 9000}, {0.5, 1, 0}});
  Constituent<double> smoke = named("smoke", AmountType::kScattering, 3e-6);
  smoke.profile.type = ProfileType::kSameAs;
  smoke.profile.of = "haze";
  for (const auto& c : {layer, haze, table, smoke}) a.constituents.push_back(c);
  return a;
}

Profile profile_of(const Atmosphere<double>& a, const Constituent<double>& c) {
  return Profile(c.profile.type == ProfileType::kSameAs ? a.at(c.profile.of).profile : c.profile);
}

// 1/m at a height, from the vertical optical depth: whatever the amount's kind.
double extinction(const Atmosphere<double>& a, const std::string& name, double height) {
  const Constituent<double>& c = a.at(name);
  const Profile profile = profile_of(a, c);
  return vertical_optical_depth(a, c, {kWavelength, kOzone}) / profile.vertical_column().value *
         profile.density(height).value;
}

TEST(LoweredGround, NothingChangesAboveTheDatum) {
  const Atmosphere<double> before = every_kind(), after = lowered_by(kDepth, before);
  EXPECT_EQ(after.bottom_radius_m, before.bottom_radius_m - kDepth);
  EXPECT_EQ(after.top_radius_m, before.top_radius_m);
  for (const Constituent<double>& c : before.constituents) {
    for (const double height : {0.0, 500.0, 3500.0, 4990.0, 20e3}) {
      const double expected = extinction(before, c.name, height);
      EXPECT_NEAR(extinction(after, c.name, height + kDepth), expected, 1e-12 * expected + 1e-22)
          << c.name << " " << height;
    }
  }
}

TEST(LoweredGround, TheAirGoesOnBelowTheDatum) {
  const Atmosphere<double> before = every_kind(), after = lowered_by(kDepth, before);
  const auto ratio = [&](const char* name, double height) {
    return extinction(after, name, height) / extinction(before, name, 0);
  };
  for (const double height : {0.0, 1000.0, 3999.0}) {
    EXPECT_NEAR(ratio("rayleigh", height), std::exp((kDepth - height) / 8000), 1e-12);
    EXPECT_NEAR(ratio("haze", height), std::exp((kDepth - height) / 2000), 1e-12);
    EXPECT_NEAR(ratio("smoke", height), std::exp((kDepth - height) / 2000), 1e-12);
    EXPECT_NEAR(ratio("table", height), 1, 1e-12);
    EXPECT_EQ(extinction(after, "layer", height), 0);
    EXPECT_EQ(extinction(after, "ozone", height), 0);
  }
  for (const char* name : {"layer", "ozone"})
    EXPECT_EQ(after.at(name).amount, before.at(name).amount) << name;
}

TEST(LoweredGround, NoDepthIsTheSameAtmosphere) {
  const Atmosphere<double> same = every_kind();
  EXPECT_EQ(lowered_by(0, same), same);
  EXPECT_THROW(lowered_by(7e6, every_kind()), std::invalid_argument);
}

}  // namespace
}  // namespace skyfit
