// SPDX-License-Identifier: Apache-2.0
// Shadows take the direct light alone, from the ground and from the air.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "model/tables/table_lookup.h"
#include "tests/render/mesh_fixture.h"

namespace skyfit {
namespace {

constexpr double kTables = 0.01;    // of small tables, between two ways through them
constexpr double kFloatSum = 2e-6;  // sums of floats in another order

// A grey floor, a wall across the sun's azimuth on it; metres about the origin of the floor.
class Wall : public ::testing::Test {
 protected:
  static constexpr double kHigh = 50, kHalfWide = 150, kNear = 90, kFar = 95, kFloor = 20;
  static constexpr double kEye = 45;  // above the floor
  static constexpr double kReflectance = 0.3;

  Wall() {
    const auto file = directory_.path() / "wall.obj";
    ObjWriter obj(file);
    obj.box({-300, -300, -2}, {300, 300, 0});
    obj.box({kNear, -kHalfWide, 0}, {kFar, kHalfWide, kHigh});
    scene_.meshes.push_back(at_the_coast(file, kFloor));
    scene_.meshes.front().reflectance = kReflectance;
  }

  // How far a point above the floor is inside the wall's shadow, metres; negative: outside. Its
  // beam enters the wall at the near side, below the top.
  double depth_in_shadow(const glm::dvec3& p) const {
    const double longest = (kHigh - p.z) * std::tan(sun_);
    return std::min({longest - (kNear - p.x), kHalfWide - std::abs(p.y), kNear - p.x});
  }

  double sun_ = 55 * kDegree;
  TemporaryDirectory directory_;
  Scene scene_;
};

TEST_F(Wall, ShadesTheFloorBehindItAndNothingElse) {
  Renderer drawn = make_renderer(scene_);
  FrameOptions options =
      options_at({kFloor + kEye, 140 * kDegree, 0.2, 80 * kDegree}, sun_, 128, 96);
  const Frame lit = draw_layers(options, drawn);
  options.shadows = true;
  const Frame shaded = draw_layers(options, drawn);

  // Light of the sky and of the sun on a horizontal surface.
  const AtmosphereTables& tables = small_tables();
  const double mu_s = std::cos(sun_);
  const NodeValues sky = lookup_irradiance(tables, kFloor, mu_s),
                   sun = lookup_sun_transmittance(tables, kFloor, mu_s);
  double diffuse = 0, direct = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    diffuse += tables.color.xyz_from_nodes[1][k] * sky[k];
    direct += tables.color.xyz_from_nodes[1][k] * sun[k] * mu_s;
  }
  const double expected = diffuse / (diffuse + direct);
  constexpr double kSoftEdge = 3;  // m: texels of the map, and the offset off the surface
  WorstPixel dark, bright;
  for (std::size_t i = 0; i < lit.luminance.size(); ++i) {
    if (is_sky(lit, i)) continue;
    const double ratio =
        luminance_of(shaded.layers->reflected, i) / luminance_of(lit.layers->reflected, i);
    EXPECT_LT(ratio, 1 + kFloatSum) << "pixel " << i;
    const glm::dvec3 p = double{lit.depth_m[i]} * ray_of(lit, i) + glm::dvec3(0, 0, kEye);
    const bool floor = std::abs(p.z) < 0.05 && std::abs(p.x) < 290 && std::abs(p.y) < 290;
    if (!floor) continue;
    const double inside = depth_in_shadow(p);
    if (inside > kSoftEdge) dark.add(lit, i, ratio / expected - 1);
    if (inside < -kSoftEdge && p.x < kNear) bright.add(lit, i, ratio - 1);
  }
  std::printf("[ shadow ] the sky's part is %.3f\n", expected);
  dark.print("in the shadow, of the sky's part");
  bright.print("in the light");
  EXPECT_GT(dark.count(), 500);
  EXPECT_GT(bright.count(), 500);
  EXPECT_LT(dark.error(), 2 * kTables);
  EXPECT_LT(bright.error(), kFloatSum);
}

TEST_F(Wall, TakesLightFromTheAirInItsShadow) {
  Renderer drawn = make_renderer(scene_);
  FrameOptions options = options_at({kFloor + kEye, 135 * kDegree, 0, 80 * kDegree}, sun_, 96, 64);
  const Frame lit = draw_layers(options, drawn);
  options.shadows = true;
  const Frame shaded = draw_layers(options, drawn);
  // What a path loses is about the shaded part of it, where the sun's part of the light is about
  // the same everywhere.
  int clear = 0, dark = 0;
  double share = 0, least = 1, most = 0;
  WorstPixel untouched;
  for (std::size_t i = 0; i < lit.luminance.size(); ++i) {
    const double before = luminance_of(lit.layers->in_scatter, i),
                 after = luminance_of(shaded.layers->in_scatter, i);
    EXPECT_GE(after, 0) << "pixel " << i;
    EXPECT_LE(after, before * (1 + kFloatSum)) << "pixel " << i;
    const glm::dvec3 end = double{lit.depth_m[i]} * ray_of(lit, i);
    if (is_sky(lit, i) || end.x > kNear + 0.1) continue;
    constexpr int kSteps = 400;
    int inside = 0, near = 0;
    for (int k = 0; k < kSteps; ++k) {
      const double depth = depth_in_shadow((k + 0.5) / kSteps * end + glm::dvec3(0, 0, kEye));
      inside += depth > 0 ? 1 : 0;
      near += depth > -3 ? 1 : 0;  // texels of the map
    }
    const double part = static_cast<double>(inside) / kSteps;
    if (near == 0) untouched.add(lit, i, after / before - 1), ++clear;
    if (part > 0.4) {
      const double taken = (1 - after / before) / part;
      share += taken;
      least = std::min(least, taken);
      most = std::max(most, taken);
      ++dark;
    }
  }
  share /= std::max(dark, 1);
  std::printf("[ shadow ] of %d shaded paths the sun's part of the light is %.3f (%.3f to %.3f)\n",
              dark, share, least, most);
  untouched.print("paths in the light");
  ASSERT_GT(dark, 300);
  ASSERT_GT(clear, 100);
  EXPECT_EQ(untouched.error(), 0);
  constexpr double kStep = 1 / 24.0 / 0.4;  // of the shader's march, of the shortest of these
  EXPECT_GT(share, 0.4);
  EXPECT_LT(most, 1);
  EXPECT_LT(most, share * (1 + kStep) + 0.1);
  EXPECT_GT(least, share * (1 - kStep) - 0.1);
}

}  // namespace
}  // namespace skyfit
