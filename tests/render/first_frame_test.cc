// SPDX-License-Identifier: Apache-2.0
// A frame does not depend on what was drawn before it: the first of a renderer is bit for bit the
// second, with everything that a frame can have.
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <ostream>

#include "tests/render/mesh_fixture.h"

namespace skyfit {
namespace {

constexpr int kWidth = 48, kHeight = 32;

struct Feature {
  const char* name;
  std::function<void(FrameOptions&)> set;
  friend void PrintTo(const Feature& feature, std::ostream* out) { *out << feature.name; }
};

void add_sky_objects(FrameOptions& options) {
  options.moon = Moon{.zenith = 1.4, .azimuth = options.camera.azimuth, .distance_m = 4e7};
  options.second_sun = SecondSun{1.3, options.camera.azimuth + 0.2, 0.5};
}

const Feature kFeatures[] = {
    {"nothing", [](FrameOptions&) {}},
    {"shadows", [](FrameOptions& options) { options.shadows = true; }},
    {"clouds", [](FrameOptions& options) { options.clouds.emplace_back(); }},
    {"moon and second sun", add_sky_objects},
    {"shadows of clouds",
     [](FrameOptions& options) {
       options.shadows = true;
       options.clouds.emplace_back();
     }},
    {"moonlight",
     [](FrameOptions& options) {
       options.sun_zenith = 120 * kDegree;
       options.moon = Moon{.zenith = 1, .azimuth = 3, .lights = true};
     }},
    {"refraction", [](FrameOptions& options) { options.refraction = true; }},
    {"layers", [](FrameOptions& options) { options.layers = true; }},
    {"air by the pixel",
     [](FrameOptions& options) { options.aerial = AerialPerspective::kPerPixel; }},
    {"all",
     [](FrameOptions& options) {
       options.shadows = options.layers = true;
       options.clouds.emplace_back();
       add_sky_objects(options);
     }},
};

// Its ground and textures take the most time and do not differ between renderers.
Renderer make_first(const Scene& scene = {}) {
  static const TemporaryDirectory directory;
  static const auto cache = std::make_shared<ContentCache>(directory.path() / "cache");
  return make_renderer(scene, GraphicsDevice::kSoftware, cache);
}

void expect_same(const Frame& first, const Frame& second) {
  EXPECT_EQ(first.rgb, second.rgb);
  EXPECT_EQ(first.luminance, second.luminance);
  EXPECT_EQ(first.depth_m, second.depth_m);
  ASSERT_EQ(first.layers.has_value(), second.layers.has_value());
  if (!first.layers) return;
  EXPECT_EQ(first.layers->in_scatter, second.layers->in_scatter);
  EXPECT_EQ(first.layers->reflected, second.layers->reflected);
  EXPECT_EQ(first.layers->direct, second.layers->direct);
  EXPECT_EQ(first.layers->transmittance, second.layers->transmittance);
  EXPECT_EQ(first.layers->normal, second.layers->normal);
  EXPECT_EQ(first.layers->albedo, second.layers->albedo);
}

class FirstFrameWith : public ::testing::TestWithParam<Feature> {};

TEST_P(FirstFrameWith, IsTheSecond) {
  FrameOptions options = options_of("valley", kWidth, kHeight);
  GetParam().set(options);
  Renderer drawn = make_first();
  const Frame first = drawn.draw(options);
  expect_same(first, drawn.draw(options));
}

INSTANTIATE_TEST_SUITE_P(Features, FirstFrameWith, ::testing::ValuesIn(kFeatures));

class FirstFrameOf : public ::testing::TestWithParam<NamedView> {};

TEST_P(FirstFrameOf, ViewWithAMeshAndAllElseIsTheSecond) {
  TemporaryDirectory directory;
  const auto file = directory.path() / "box.obj";
  { ObjWriter(file).box({20, -10, 0}, {40, 10, 30}); }
  Scene scene;
  scene.meshes.push_back(at_the_coast(file, 20));
  FrameOptions options = options_of(GetParam().name, kWidth, kHeight);
  std::end(kFeatures)[-1].set(options);
  Renderer drawn = make_first(scene);
  const Frame first = drawn.draw(options);
  expect_same(first, drawn.draw(options));
}

INSTANTIATE_TEST_SUITE_P(Views, FirstFrameOf, ::testing::ValuesIn(named_views()));

TEST(FirstFrame, HasShadows) {
  FrameOptions options = options_of("valley", kWidth, kHeight);
  options.sun_zenith = 74 * kDegree;
  const Frame lit = make_first().draw(options);
  options.shadows = true;
  const Frame shaded = make_first().draw(options);
  int darker = 0;
  for (std::size_t i = 0; i < lit.luminance.size(); ++i)
    darker += shaded.luminance[i] < 0.9f * lit.luminance[i] ? 1 : 0;
  std::printf("[ shadow ] darker: %d of %zu pixels\n", darker, lit.luminance.size());
  EXPECT_GT(darker, kWidth * kHeight / 20);
}

}  // namespace
}  // namespace skyfit
