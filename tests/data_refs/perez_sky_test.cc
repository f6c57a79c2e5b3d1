// SPDX-License-Identifier: Apache-2.0
// The all-weather sky of Perez 1993 by hand, its overcast bin included; names that it refuses.
#include "data_refs/perez_sky.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "data_refs/references.h"

namespace skyfit::refs {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

// Sun at 40 deg, a direction at 60 deg across: worked out from the published coefficients.
TEST(Perez, ByHand) {
  const double angle = std::acos(std::cos(40 * kDegree) * std::cos(60 * kDegree));
  EXPECT_NEAR(perez_relative_luminance({4, 0.15}, 40 * kDegree, 60 * kDegree, angle),
              0.9144253140700589, 1e-12);
  EXPECT_NEAR(perez_relative_luminance({1, 0.2}, 40 * kDegree, 60 * kDegree, angle),
              0.7919198137335062, 1e-12);
}

TEST(Perez, IsAReferenceWithAScanPerSun) {
  const Reference sky = load_reference("perez:6.5,0.12", {0.3, 0.9}, Sampling::kTregenza);
  EXPECT_EQ(sky.samples.size(), 290u);
  EXPECT_EQ(sky.quantity, Quantity::kRelativeLuminance);
  EXPECT_EQ(sky.samples.back().scan, 1);
}

TEST(Perez, ItsCommaPartsNoNames) {
  EXPECT_THAT(reference_names("perez:4,0.15"), ElementsAre("perez:4,0.15"));
  EXPECT_THAT(reference_names("perez:4,0.15,cie:12"), ElementsAre("perez:4,0.15", "cie:12"));
  EXPECT_THAT(reference_names("a.csv,perez:4,0.15,perez:1,0.2"),
              ElementsAre("a.csv", "perez:4,0.15", "perez:1,0.2"));
  EXPECT_THAT(reference_names("perez:w.epw@2026-06-21T12:00,a.csv"),
              ElementsAre("perez:w.epw@2026-06-21T12:00", "a.csv"));
  EXPECT_THAT(reference_names("perez:4"), ElementsAre("perez:4"));
  EXPECT_THAT(reference_names("a,,b"), ElementsAre("a", "", "b"));
}

TEST(Perez, NamesThatAreNone) {
  for (const auto& [name, expected] : {std::pair{"perez:4", "perez:EPSILON,DELTA"},
                                       {"perez:x,0.1", "\"x\""},
                                       {"perez:4,0.1x", "\"0.1x\""},
                                       {"perez:0.5,0.1", "epsilon = 0.5"},
                                       {"perez:4,0", "delta = 0"},
                                       {"perez:4,nan", "nan"}}) {
    EXPECT_THAT([name = name] { load_reference(name, {0.5}, Sampling::kPrincipalPlane); },
                ThrowsMessage<std::invalid_argument>(HasSubstr(expected)))
        << name;
  }
  EXPECT_THROW(load_reference("perez:4,0.1", {}, Sampling::kPrincipalPlane), std::invalid_argument);
}

}  // namespace
}  // namespace skyfit::refs
