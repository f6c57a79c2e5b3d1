// SPDX-License-Identifier: Apache-2.0
// Shadows take the direct light alone, from the ground and from the air.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "model/tables/table_lookup.h"
#include "render/gl/passes/shadow_pass.h"
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
  constexpr double kSoftEdge = 5;  // m: 8 texels, of the filter and of the offset off the surface
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

// From orbit the maps have texels of half a kilometre and more. No texel of theirs may shade the
// sea, but for mountains at the coast, nor the air at the limb, however low the sun.
TEST(Shadow, FromOrbitLeavesSeaAndLimbAlone) {
  FrameOptions options = options_of("orbit", 160, 90);
  options.samples_per_quad = 2;  // mountains as high as in a large picture
  const double bottom = earth_clear().atmosphere.bottom_radius_m;
  const glm::dvec3 eye(0, 0, bottom + options.camera.altitude_m);
  constexpr double kSea = 5;                 // m: floats of 1e6 m, and of the ray
  constexpr double kCoast = 0.02;            // share of the sea
  constexpr double kMountainsAtLimb = 0.03;  // of the light along a path
  constexpr double kMountains = 0.05;        // share of the land
  int all_shaded = 0;
  for (const auto& [sun_deg, view_deg] : {std::pair{60.0, 125.0},
                                          {82.0, 125.0},
                                          {87.0, 125.0},
                                          {60.0, 150.0},
                                          {75.0, 150.0},
                                          {82.0, 150.0},
                                          {87.0, 150.0}}) {
    options.sun_zenith = sun_deg * kDegree;
    options.camera.view_zenith = view_deg * kDegree;
    options.shadows = false;
    const Frame lit = draw_layers(options);
    options.shadows = true;
    const Frame shaded = draw_layers(options);
    int sea = 0, shaded_sea = 0, land = 0, shaded_land = 0;
    WorstPixel limb;
    for (std::size_t i = 0; i < lit.luminance.size(); ++i) {
      if (is_sky(lit, i)) {
        const double before = luminance_of(lit.layers->in_scatter, i);
        if (before > 1) limb.add(lit, i, luminance_of(shaded.layers->in_scatter, i) / before - 1);
        continue;
      }
      const bool is_sea =
          glm::length(eye + double{lit.depth_m[i]} * ray_of(lit, i)) < bottom + kSea;
      const double before = luminance_of(lit.layers->reflected, i),
                   after = luminance_of(shaded.layers->reflected, i);
      ++(is_sea ? sea : land);
      if (after < (1 - kFloatSum) * before) ++(is_sea ? shaded_sea : shaded_land);
    }
    std::printf("[ shadow ] sun %g deg: %d of %d pixels of the sea are shaded, %d of %d of land\n",
                sun_deg, shaded_sea, sea, shaded_land, land);
    limb.print("limb");
    EXPECT_GT(sea, 1000);
    if (view_deg < 130) {
      EXPECT_GT(limb.count(), 100);
    }
    EXPECT_LT(shaded_sea, kCoast * sea);
    EXPECT_LT(shaded_land, kMountains * land);
    all_shaded += shaded_land;
    EXPECT_LT(limb.error(), kMountainsAtLimb);
  }
  EXPECT_GT(all_shaded, 50);
}

TEST(Shadow, MapsThatCannotHoldAShadowAreLeftOut) {
  constexpr double kHighest = 6e3;  // m
  const auto maps = [](double distance_m) {
    return shadow_views({0.6, 0, 0.8}, distance_m, kHighest).size();
  };
  EXPECT_EQ(maps(2), 3u);
  EXPECT_EQ(maps(400e3), 1u);
  EXPECT_EQ(maps(11e6), 0u);
}

}  // namespace
}  // namespace skyfit
