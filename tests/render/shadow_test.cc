// SPDX-License-Identifier: Apache-2.0
// Shadows take the direct light alone, from the ground and from the air, under each sun and by
// every model that draws.
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <string_view>
#include <utility>

#include "data_refs/spectra.h"
#include "model/registry.h"
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

  // Of the light along paths of which 0.4 and more lie in the wall's shadow: what the shadow takes,
  // over the shaded part of the path. Checks that no path becomes brighter.
  struct Taken {
    int paths = 0;
    double mean = 0, least = 1, most = 0;
    WorstPixel untouched;  // of paths outside of the shadow
  };
  Taken light_taken(Renderer& drawn) const {
    FrameOptions options =
        options_at({kFloor + kEye, 135 * kDegree, 0, 80 * kDegree}, sun_, 96, 64);
    const Frame lit = draw_layers(options, drawn);
    options.shadows = true;
    const Frame shaded = draw_layers(options, drawn);
    // What a path loses is about the shaded part of it, where the sun's part of the light is about
    // the same everywhere.
    Taken taken;
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
      if (near == 0) taken.untouched.add(lit, i, after / before - 1);
      if (part <= 0.4) continue;
      const double of_part = (1 - after / before) / part;
      taken.mean = (taken.mean * taken.paths + of_part) / (taken.paths + 1);
      taken.least = std::min(taken.least, of_part);
      taken.most = std::max(taken.most, of_part);
      ++taken.paths;
    }
    std::printf(
        "[ shadow ] of %d shaded paths the sun's part of the light is %.3f (%.3f to %.3f)\n",
        taken.paths, taken.mean, taken.least, taken.most);
    taken.untouched.print("paths in the light");
    EXPECT_GT(taken.paths, 300);
    EXPECT_GT(taken.untouched.count(), 100);
    EXPECT_EQ(taken.untouched.error(), 0);
    return taken;
  }

  // One for all: its ground and its shaders take the most time.
  Renderer& drawn_by(const AtmosphereTables& tables) const {
    static Renderer drawn(scene_);
    drawn.set_atmosphere(earth_clear(), tables);
    return drawn;
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
  Renderer& drawn = drawn_by(small_tables());
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
  Renderer& drawn = drawn_by(small_tables());
  const Taken taken = light_taken(drawn);
  constexpr double kStep = 1 / 24.0 / 0.4;  // of the shader's march, of the shortest of these
  EXPECT_GT(taken.mean, 0.4);
  EXPECT_LT(taken.most, 1);
  EXPECT_LT(taken.most, taken.mean * (1 + kStep) + 0.1);
  EXPECT_GT(taken.least, taken.mean * (1 - kStep) - 0.1);
}

AtmosphereTables tables_by(const char* model) {
  const SpectralData& spectra = refs::standard_spectral_data();
  return compute_tables_of(*make_sky_model(model, spectra, 2), earth_clear().atmosphere,
                           color_rule(spectra), kSmallTables, 2, {});
}

struct Shafts {
  const char* model;
  double least, most;  // the sun's part of the light along a short path
  friend void PrintTo(const Shafts& shafts, std::ostream* out) { *out << shafts.model; }
};
class ShaftsBy : public Wall, public ::testing::WithParamInterface<Shafts> {};

TEST_P(ShaftsBy, TakeTheSunsPartOfTheLightOfShadedAir) {
  const auto& [model, least, most] = GetParam();
  Renderer& drawn = drawn_by(tables_by(model));
  const Taken taken = light_taken(drawn);
  EXPECT_GT(taken.mean, least);
  EXPECT_LT(taken.mean, most);
  // Without meshes the air comes from the volume, of the models that have one.
  for (const AerialPerspective aerial :
       {AerialPerspective::kVolume, AerialPerspective::kPerPixel}) {
    FrameOptions options = options_of("valley", 48, 32);
    options.sun_zenith = 74 * kDegree;
    options.aerial = aerial;
    const Frame lit = draw_layers(options, drawn);
    options.shadows = true;
    const Frame shaded = draw_layers(options, drawn);
    int darker = 0;
    for (std::size_t i = 0; i < lit.luminance.size(); ++i) {
      const double before = luminance_of(lit.layers->in_scatter, i),
                   after = luminance_of(shaded.layers->in_scatter, i);
      EXPECT_LE(after, before * (1 + kFloatSum)) << "pixel " << i;
      darker += after < 0.97 * before ? 1 : 0;
    }
    std::printf("[ shafts ] %s: %d of %zu paths are darker\n", model, darker, lit.luminance.size());
    EXPECT_GT(darker, 50);
  }
}

// What is scattered once is the sun's alone.
constexpr double kMarch = 0.05;  // of 24 steps and the shadow's edge, in the mean of all paths
constexpr double kOnce = 1 - kMarch, kAll = 1 + kMarch;
constexpr double kDifference = 1.25;  // of two long rays in small tables: the light of 60 m
constexpr Shafts kShafts[] = {{"reference", 0.4, 0.95},
                              {"bruneton", 0.4, 0.95},
                              {"bodare", 0.4, 0.95},
                              {"hillaire", 0.4, 0.95},
                              {"schafhitzel", kOnce, kDifference},
                              {"oneil", kOnce, kAll},
                              {"oneil:isotropic-air", kOnce, kAll},
                              {"nielsen:sun-through-sky", kOnce, kAll},
                              {"preetham", 0.4, 0.95},
                              {"hosek-wilkie", 0.4, 0.95},
                              {"hoffman-preetham", kOnce, kAll}};
// The last, whose shafts have lines of the shader of their own; the others take a minute.
INSTANTIATE_TEST_SUITE_P(Models, ShaftsBy, ::testing::Values(kShafts[std::size(kShafts) - 1]));
INSTANTIATE_TEST_SUITE_P(SlowModels, ShaftsBy, ::testing::ValuesIn(kShafts));

TEST(Shadow, EveryModelThatDrawsHasShafts) {
  for (const SkyModelEntry& entry : sky_models()) {
    if (entry.name == "tables") continue;  // drawn as `reference`
    EXPECT_TRUE(std::ranges::any_of(kShafts, [&](const Shafts& shafts) {
      return std::string_view(shafts.model).starts_with(entry.name);
    })) << entry.name;
  }
}

// Of a formula, whose sky may hold less light than the beam that the steps of the shadow find.
TEST(Shadow, OfCloudsLeavesLightInTheSkyOfAFormula) {
  constexpr double kDark = 0.02;  // share of the light before
  Renderer renderer;
  const Preset preset = shipped("earth-hazy");
  const SpectralData& spectra = refs::standard_spectral_data();
  renderer.set_atmosphere(
      preset, compute_tables_of(*make_sky_model("preetham", spectra, 2), preset.atmosphere,
                                color_rule(spectra), TableSizes{}, 2, {}));
  FrameOptions options = options_of("sunset", 96, 54);
  options.sun_zenith = 75 * kDegree;
  options.clouds = {CloudLayer{.altitude_m = 2000, .cover = 0.4}};
  options.layers = true;
  const Frame lit = renderer.draw(options);
  options.shadows = true;
  const Frame shaded = renderer.draw(options);
  int skies = 0, shaded_skies = 0;
  for (std::size_t i = 0; i < lit.luminance.size(); ++i) {
    if (!is_sky(lit, i)) continue;
    ++skies;
    const double before = luminance_of(lit.layers->in_scatter, i),
                 after = luminance_of(shaded.layers->in_scatter, i);
    EXPECT_GT(after, kDark * before) << "pixel " << i;
    shaded_skies += after < 0.9 * before ? 1 : 0;
  }
  EXPECT_GT(skies, 1000);
  EXPECT_GT(shaded_skies, 300);
}

// Two suns of the same light: which of them is the first makes no difference.
TEST(Shadow, OfTheSecondSunIsThatOfTheFirst) {
  FrameOptions options = options_of("valley", 64, 40);
  options.shadows = true;
  options.sun_zenith = 74 * kDegree;
  options.second_sun = SecondSun{65 * kDegree, 70 * kDegree, 1};
  FrameOptions swapped = options;
  swapped.sun_zenith = options.second_sun->zenith;
  swapped.second_sun = SecondSun{options.sun_zenith, -options.second_sun->azimuth, 1};
  swapped.camera.azimuth -= options.second_sun->azimuth;
  if (swapped.site) swapped.site->sun_azimuth += options.second_sun->azimuth;
  const Frame a = draw_layers(options), b = draw_layers(swapped);
  options.shadows = false;
  const Frame lit = draw_layers(options);
  WorstPixel direct, air;
  int edges = 0, shaded = 0;
  for (std::size_t i = 0; i < a.luminance.size(); ++i) {
    const double of_a = luminance_of(a.layers->direct, i), of_b = luminance_of(b.layers->direct, i);
    const double before = luminance_of(lit.layers->in_scatter, i);
    air.add(
        a, i,
        (luminance_of(a.layers->in_scatter, i) - luminance_of(b.layers->in_scatter, i)) / before);
    shaded += of_a < 0.9 * luminance_of(lit.layers->direct, i) ? 1 : 0;
    // At the edge of a shadow a rounding may decide.
    if (std::abs(of_a - of_b) > 1e-3 * luminance_of(lit.layers->direct, i)) ++edges;
  }
  air.print("air under suns in the other order");
  std::printf("[ shadow ] %d pixels shaded, %d differ\n", shaded, edges);
  EXPECT_GT(shaded, 300);
  EXPECT_LT(edges, 0.01 * 64 * 40);
  EXPECT_LT(air.rms(), 2e-3);
}

// From orbit the maps have texels of half a kilometre and more. No texel of theirs may shade the
// sea, but for mountains at the coast, nor the air at the limb, however low the sun.
TEST(Shadow, FromOrbitLeavesSeaAndLimbAlone) {
  FrameOptions options = options_of("orbit", 160, 90);
  options.samples_per_quad = 1;  // mountains as high as in a large picture
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
