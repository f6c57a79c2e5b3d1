// SPDX-License-Identifier: Apache-2.0
// Where an eye sees ground and limb through air, beside Bouguer's law and the bending of the rays.
#include "model/shared/seen_refracted.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "model/atmosphere/refraction.h"

namespace skyfit {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

class SeenRefracted : public ::testing::Test {
 protected:
  const Atmosphere<double> atmosphere_{};
  const Refraction refraction_{atmosphere_, 550};
  const double bottom_ = atmosphere_.bottom_radius_m;
  const Refraction::NearGround air_ = refraction_.near_ground();
  SharedSeenRefracted<double> shared_;
};

// docs/theory (14.8) from the point of the ground to the eye.
TEST_F(SeenRefracted, PointsOfTheGroundAreLifted) {
  for (const double height : {100.0, 3e3, 10e3, 400e3}) {
    for (const double leaves : {30.0, 60.0, 80.0, 87.0, 89.0, 89.9}) {
      const double zenith = leaves * kDegree, x = refraction_.refractive_height(height),
                   ground = bottom_ * refraction_.refractive_index(0),
                   at_eye = std::asin(ground / (ground + x) * std::sin(zenith)),
                   turn = zenith - at_eye + refraction_.bending(0, zenith) -
                          refraction_.bending(x, at_eye);
      const double across = bottom_ * std::sin(turn),
                   rise = bottom_ * std::cos(turn) - bottom_ - height,
                   distance = std::hypot(across, rise),
                   expected = std::acos(rise / distance) - (std::numbers::pi - at_eye),
                   lift = shared_.lift_by_air(height, rise / distance, distance, bottom_,
                                              air_.refractivity, air_.scale_height);
      std::printf("[ lift   ] from %6g m, ray %4.1f deg from the zenith: %8.3f of %8.3f mdeg\n",
                  height, leaves, 1e3 * lift / kDegree, 1e3 * expected / kDegree);
      constexpr double kRelative = 0.02, kLeast = 2e-4 * kDegree;
      EXPECT_NEAR(lift, expected, kRelative * std::abs(expected) + kLeast);
    }
  }
}

// The ray that Bouguer's law lets touch a height there.
TEST_F(SeenRefracted, RaysPastTheGroundComeAsNear) {
  for (const double height : {2.0, 3e3, 400e3}) {
    for (const double touches : {0.0, 1.0, 2e3, 8e3, 30e3}) {
      if (touches >= height) continue;
      const double index = 1 + air_.refractivity * std::exp(-touches / air_.scale_height),
                   at_eye = 1 + air_.refractivity * std::exp(-height / air_.scale_height),
                   sine = (bottom_ + touches) * index / ((bottom_ + height) * at_eye),
                   mu = shared_.straight_mu_as_near(-std::sqrt(1 - sine * sine), height, bottom_,
                                                    air_.refractivity, air_.scale_height);
      const double lowest = (bottom_ + height) * std::sqrt(1 - mu * mu) - bottom_;
      EXPECT_NEAR(lowest, touches, 0.01) << height;
    }
  }
}

}  // namespace
}  // namespace skyfit
