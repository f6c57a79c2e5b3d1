// SPDX-License-Identifier: Apache-2.0
// A mapping followed by its inverse is the identity, and its derivative by a dual number is that of
// a central difference.
#include <ceres/jet.h>
#include <gtest/gtest.h>

#include <cmath>

#include "model/shared/shared.h"

namespace skyfit {
namespace {

constexpr double kRoundTrip = 1e-9;  // square roots of differences of about 1e-16
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
    const double h = shared_.height_from_unit(x, bottom_, thickness_);
    EXPECT_NEAR(shared_.unit_from_height(h, bottom_, thickness_), x, kRoundTrip);
  }
}

TEST_P(MappingRoundTrip, ViewZenithInBothHalves) {
  constexpr int kSize = 128;
  for (double x = 1.0 / 32; x <= 1; x += 1.0 / 32) {
    const double h = shared_.height_from_unit(x, bottom_, thickness_);
    for (int i = 0; i < kSize; ++i) {
      const double u = (i + 0.5) / kSize;
      const double mu = shared_.mu_from_texture(u, h, kSize, bottom_, thickness_);
      EXPECT_NEAR(shared_.texture_from_view(h, mu, u < 0.5, kSize, bottom_, thickness_), u, 1e-6)
          << "h = " << h;
    }
  }
}

TEST_P(MappingRoundTrip, HalvesMeetAtTheHorizon) {
  const double h = 0.02 * thickness_;
  const double horizon = -shared_.horizon_distance(h, bottom_) / (bottom_ + h);
  EXPECT_NEAR(shared_.mu_from_ground_unit(1, h, bottom_), horizon, kRoundTrip);
  EXPECT_NEAR(shared_.mu_from_upward_unit(1, h, bottom_, thickness_), horizon, kRoundTrip);
}

TEST_P(MappingRoundTrip, Sun) {
  for (double x = 0; x <= 1; x += 1.0 / 32) {
    const double mu_s = shared_.sun_from_unit(x, -0.2079, bottom_, thickness_);
    EXPECT_NEAR(shared_.unit_from_sun(mu_s, -0.2079, bottom_, thickness_), x, kRoundTrip);
  }
  EXPECT_NEAR(shared_.sun_from_unit(0, -0.2079, bottom_, thickness_), -0.2079, kRoundTrip);
  EXPECT_NEAR(shared_.sun_from_unit(1, -0.2079, bottom_, thickness_), 1, kRoundTrip);
}

TEST_P(MappingRoundTrip, Cosine) {
  for (double x = 0; x <= 1; x += 1.0 / 32) {
    EXPECT_NEAR(shared_.unit_from_cosine(shared_.cosine_from_unit(x)), x, kRoundTrip);
  }
}

TEST_P(MappingRoundTrip, JetsAgreeWithDifferences) {
  Shared<Jet> jets;
  const Jet bottom(bottom_), thickness(thickness_);
  const double step = 1e-6;
  for (const double mu : {-0.9, -0.3, 0.02, 0.4, 0.95}) {
    const double h = 0.05 * thickness_;
    const bool hit = shared_.ray_hits_ground(h, mu, bottom_);
    const Jet jet = jets.texture_from_view(Jet(h), Jet(mu, 0), hit, Jet(128.0), bottom, thickness);
    const auto plain = [&](double m) {
      return shared_.texture_from_view(h, m, hit, 128, bottom_, thickness_);
    };
    EXPECT_DOUBLE_EQ(jet.a, plain(mu));
    EXPECT_NEAR(jet.v[0], (plain(mu + step) - plain(mu - step)) / (2 * step),
                kDifference * (1 + std::abs(jet.v[0])));
    const Jet sun = jets.unit_from_sun(Jet(mu, 0), Jet(-0.2079), bottom, thickness);
    const auto plain_sun = [&](double m) {
      return shared_.unit_from_sun(m, -0.2079, bottom_, thickness_);
    };
    const double slope = (plain_sun(mu + step) - plain_sun(mu - step)) / (2 * step);
    EXPECT_NEAR(sun.v[0], slope, kDifference * (1 + std::abs(slope)));
  }
}

INSTANTIATE_TEST_SUITE_P(Worlds, MappingRoundTrip,
                         ::testing::Values(World{6360e3, 100e3}, World{6360, 60},
                                           World{3390e3, 100e3}));

}  // namespace
}  // namespace skyfit
