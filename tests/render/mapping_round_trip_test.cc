// SPDX-License-Identifier: Apache-2.0
// A mapping followed by its inverse is the identity, and its derivative by a dual number is that of
// a central difference.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/shared/shared.h"

namespace skyfit {
namespace {

constexpr double kRoundTrip = 1e-9;   // square roots of differences of about 1e-16
constexpr double kNearZenith = 1e-6;  // powers of such roots
constexpr double kDifference = 1e-6;
using Jet = ceres::Jet<double, 1>;

struct World {
  double bottom, thickness;
};
class MappingRoundTrip : public ::testing::TestWithParam<World> {
 protected:
  Shared<double> shared_;
  double bottom_ = GetParam().bottom, thickness_ = GetParam().thickness;
};

TEST_P(MappingRoundTrip, Height) {
  for (double x = 0; x <= 1; x += 1.0 / 32) {
    const double h = shared_.height_from_unit(x, thickness_);
    EXPECT_NEAR(shared_.unit_from_height(h, thickness_), x, kRoundTrip);
  }
}

// As rounding leaves them: a little too high to meet the sphere, or upward.
TEST_P(MappingRoundTrip, RaysThatGrazeTheGroundMeetItByTheHorizon) {
  for (double h = 1e-9 * thickness_; h < thickness_; h *= 10) {
    const double horizon = shared_.horizon_distance(h, bottom_), tangent = -horizon / (bottom_ + h);
    for (const double mu : {tangent * (1 - 1e-7), tangent + 1e-6, 1e-9, 0.0}) {
      if (shared_.ray_hits_ground(h, mu, bottom_)) continue;
      const double d = shared_.distance_to_inner_sphere(bottom_, h, mu, 0);
      EXPECT_NEAR(d / horizon, 1, kRoundTrip) << "h = " << h << ", mu = " << mu;
    }
  }
}

TEST_P(MappingRoundTrip, ViewZenithInBothHalves) {
  constexpr int kGround = 32, kSky = 64;
  for (const double deck : {-1.0, 0.02 * thickness_}) {
    for (double x = 1.0 / 32; x <= 1; x += 1.0 / 32) {
      const double h = shared_.height_from_unit(x, thickness_);
      for (int i = 0; i < kGround + kSky; ++i) {
        const double u = (i + 0.5) / (kGround + kSky);
        const double mu = shared_.mu_from_texture(u, h, kGround, kSky, bottom_, thickness_, deck);
        EXPECT_NEAR(
            shared_.texture_from_view(h, mu, i < kGround, kGround, kSky, bottom_, thickness_, deck),
            u, kNearZenith)
            << "h = " << h << ", deck " << deck;
      }
    }
  }
}

// A third of the texels of rays to the sky, at every height.
TEST_P(MappingRoundTrip, TheDecksHorizonLiesOnOneTexel) {
  const double deck = 0.02 * thickness_;
  for (const double h : {deck, 1.001 * deck, 2 * deck, 0.5 * thickness_, thickness_}) {
    const double horizon =
        shared_.mu_from_texture((21 + 0.5) / 64, h, 0, 64, bottom_, thickness_, deck);
    EXPECT_NEAR((bottom_ + h) * std::sqrt(1 - horizon * horizon), bottom_ + deck,
                1e-9 * (bottom_ + h));
  }
  const double level =
      shared_.mu_from_texture((21 + 0.5) / 64, 0.5 * deck, 0, 64, bottom_, thickness_, deck);
  EXPECT_NEAR(level, 0, 1e-9);
}

TEST_P(MappingRoundTrip, HalvesMeetAtTheHorizon) {
  const double h = 0.02 * thickness_;
  const double horizon = -shared_.horizon_distance(h, bottom_) / (bottom_ + h);
  EXPECT_NEAR(shared_.mu_from_ground_unit(1, h, bottom_), horizon, kRoundTrip);
  EXPECT_NEAR(shared_.mu_from_upward_unit(1, h, bottom_, thickness_), horizon, kRoundTrip);
}

TEST_P(MappingRoundTrip, Sun) {
  for (double x = 0; x <= 1; x += 1.0 / 32) {
    const double mu_s = shared_.sun_from_unit(x, -0.2079);
    EXPECT_NEAR(shared_.unit_from_sun(mu_s, -0.2079), x, kRoundTrip);
  }
  EXPECT_NEAR(shared_.sun_from_unit(0, -0.2079), -0.2079, kRoundTrip);
  EXPECT_NEAR(shared_.sun_from_unit(1, -0.2079), 1, kRoundTrip);
}

TEST_P(MappingRoundTrip, SunHeight) {
  for (const double h : {0.0, 0.01 * thickness_, 0.6 * thickness_}) {
    for (double height = -0.2; height <= 1; height += 1.0 / 32) {
      const double mu_s = shared_.mu_s_from_sun_height(h, height, bottom_);
      EXPECT_NEAR(shared_.sun_height(h, mu_s, bottom_), height, kRoundTrip);
    }
    EXPECT_NEAR(shared_.sun_height(h, 1, bottom_), 1, kRoundTrip);
  }
}

TEST_P(MappingRoundTrip, Azimuth) {
  for (double x = 0; x <= 1; x += 1.0 / 32) {
    for (const double mu : {-0.7, 0.01, 0.98}) {
      for (const double mu_s : {-0.1, 0.3, 0.99}) {
        const double nu = mu * mu_s + std::sqrt((1 - mu * mu) * (1 - mu_s * mu_s)) *
                                          shared_.cosine_from_azimuth_unit(x);
        const double unit = shared_.unit_from_azimuth(shared_.cosine_of_azimuth(mu, mu_s, nu));
        EXPECT_NEAR(unit, x, 1e-6) << "mu = " << mu << ", mu_s = " << mu_s;  // acos near 1
      }
    }
  }
}

TEST_P(MappingRoundTrip, JetsAgreeWithDifferences) {
  Shared<Jet> jets;
  const Jet bottom(bottom_), thickness(thickness_);
  const double step = 1e-6;
  for (const double mu : {-0.9, -0.3, 0.02, 0.4, 0.95}) {
    const double h = 0.05 * thickness_;
    const bool hit = shared_.ray_hits_ground(h, mu, bottom_);
    const Jet jet = jets.texture_from_view(Jet(h), Jet(mu, 0), hit, Jet(32.0), Jet(64.0), bottom,
                                           thickness, Jet(0.02 * thickness_));
    const auto plain = [&](double m) {
      return shared_.texture_from_view(h, m, hit, 32, 64, bottom_, thickness_, 0.02 * thickness_);
    };
    EXPECT_DOUBLE_EQ(jet.a, plain(mu));
    EXPECT_NEAR(jet.v[0], (plain(mu + step) - plain(mu - step)) / (2 * step),
                kDifference * (1 + std::abs(jet.v[0])));
    const Jet sun = jets.unit_from_sun(Jet(mu, 0), Jet(-0.2079));
    const auto plain_sun = [&](double m) { return shared_.unit_from_sun(m, -0.2079); };
    const double slope = (plain_sun(mu + step) - plain_sun(mu - step)) / (2 * step);
    EXPECT_NEAR(sun.v[0], slope, kDifference * (1 + std::abs(slope)));
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, MappingRoundTrip,
                         ::testing::Values(World{6360e3, 100e3}, World{6360, 60},
                                           World{3390e3, 100e3}));

}  // namespace
}  // namespace skyfit
