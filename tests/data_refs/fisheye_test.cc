// SPDX-License-Identifier: Apache-2.0
// Every projection puts pixels where its formula says, and the pixels together see the hemisphere.
#include "data_refs/fisheye.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>
#include <string>

#include "complaint.h"

namespace skyfit::refs {
namespace {

constexpr double kPi = std::numbers::pi, kDegree = kPi / 180;
constexpr double kRounding = 1e-9;
constexpr int kSide = 400;

ImportOptions lens(const std::string& projection, const std::string& polynomial = {}) {
  ImportOptions facts;
  facts.projection = projection;
  if (!polynomial.empty()) facts.lens_polynomial = polynomial;
  return facts;
}

const std::vector<ImportOptions> kLenses = {lens("equidistant"), lens("equisolid"),
                                            lens("orthographic"), lens("stereographic"),
                                            lens("polynomial", "1.1,0,-0.1")};

TEST(Fisheye, RadiusOfEveryProjectionIsItsFormula) {
  for (const int deg : {1, 30, 60, 85}) {
    const double t = deg * kDegree, s = deg / 90.0;
    const std::vector<double> radii = {s, std::sin(t / 2) / std::sin(kPi / 4), std::sin(t),
                                       std::tan(t / 2), 1.1 * s - 0.1 * s * s * s};
    for (std::size_t i = 0; i < kLenses.size(); ++i) {
      const Fisheye fisheye(kLenses[i], kSide, kSide, "sky.exr");
      const auto view = fisheye.view(kSide / 2.0, kSide / 2.0 * (1 - radii[i]));
      ASSERT_TRUE(view.has_value());
      EXPECT_NEAR(view->zenith, t, kRounding) << *kLenses[i].projection;
      EXPECT_NEAR(view->azimuth, 0, kRounding);
    }
  }
}

TEST(Fisheye, PixelsTogetherSeeTheHemisphere) {
  // The rim of the circle is a staircase of pixels; that of the orthographic one holds most.
  constexpr double kRim = 0.01;
  for (const ImportOptions& facts : kLenses) {
    const Fisheye fisheye(facts, kSide, kSide, "sky.exr");
    double sum = 0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const auto view = fisheye.view(x + 0.5, y + 0.5);
        // The orthographic pixel's share grows without bound toward the horizon.
        if (view && view->zenith < 80 * kDegree) sum += view->solid_angle_sr;
      }
    }
    EXPECT_NEAR(sum / (2 * kPi * (1 - std::cos(80 * kDegree))), 1, kRim) << *facts.projection;
  }
}

TEST(Fisheye, NorthAndEastLieWhereTheFactsSay) {
  const auto azimuth_deg = [](const ImportOptions& facts, double x, double y) {
    return Fisheye(facts, kSide, kSide, "sky.exr").view(x, y)->azimuth / kDegree;
  };
  ImportOptions facts = lens("equidistant");
  const double middle = kSide / 2.0;
  EXPECT_NEAR(azimuth_deg(facts, middle, 100), 0, kRounding);
  EXPECT_NEAR(azimuth_deg(facts, 100, middle), 90, kRounding);  // one looks up: east is left
  EXPECT_NEAR(azimuth_deg(facts, 300, middle), -90, kRounding);
  facts.east = "right";
  EXPECT_NEAR(azimuth_deg(facts, 300, middle), 90, kRounding);
  facts.north_deg = 90;  // on the right
  EXPECT_NEAR(azimuth_deg(facts, 300, middle), 0, kRounding);
  EXPECT_NEAR(azimuth_deg(facts, middle, 300), 90, kRounding);
  facts.east = "left";
  EXPECT_NEAR(azimuth_deg(facts, middle, 100), 90, kRounding);
}

TEST(Fisheye, CentreAndRadiusAreThoseOfTheFacts) {
  ImportOptions facts = lens("equidistant");
  facts.centre_x_px = 150;
  facts.centre_y_px = 180;
  facts.radius_px = 90;
  const Fisheye fisheye(facts, kSide, 300, "sky.exr");
  EXPECT_NEAR(fisheye.view(150, 150)->zenith, 30 * kDegree, kRounding);
  EXPECT_FALSE(fisheye.view(150, 89).has_value());
  EXPECT_FALSE(fisheye.view(241, 180).has_value());
  const Fisheye by_default(lens("equidistant"), kSide, 300, "sky.exr");
  EXPECT_NEAR(by_default.view(200, 100)->zenith, 30 * kDegree, kRounding);
}

TEST(Fisheye, FaultsAreNamed) {
  const auto complaint = [](const ImportOptions& facts) {
    return complaint_of([&] { Fisheye(facts, kSide, kSide, "sky.exr"); });
  };
  EXPECT_EQ(complaint({}),
            "sky.exr: projection: not stated, expected equidistant, equisolid, orthographic, "
            "stereographic, polynomial, equirectangular, angular, cube or octahedral");
  EXPECT_EQ(complaint(lens("polynomial")),
            "sky.exr: lens_polynomial: not stated, expected C1,C2,..");
  EXPECT_EQ(complaint(lens("equisolid", "1")),
            "sky.exr: lens_polynomial: expected with projection polynomial, got equisolid");
  EXPECT_THAT(complaint(lens("polynomial", "1,-0.8")),
              testing::StartsWith("sky.exr: lens_polynomial = 1,-0.8: expected a radius that grows "
                                  "to the horizon; at 57 deg it does not"));
}

}  // namespace
}  // namespace skyfit::refs
