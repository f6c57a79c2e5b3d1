// SPDX-License-Identifier: Apache-2.0
// What EGL draws, on a GPU where there is one: the software's picture, by other shaders.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

constexpr double kAgreement = 0.01;  // of the mean

// Sum of the differences by that of the values, the sun's disc left out.
double difference_of(const std::vector<float>& a, const std::vector<float>& b) {
  constexpr float kDisc = 1e6f;
  double values = 0, differences = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i]) > kDisc) continue;
    values += std::abs(a[i]);
    differences += std::abs(a[i] - b[i]);
  }
  return differences / values;
}

TEST(Gpu, DrawsTheSamePicture) {
  std::optional<Renderer> gpu;
  try {
    gpu.emplace(make_renderer({}, GraphicsDevice::kGpu));
  } catch (const std::runtime_error& error) {
    GTEST_SKIP() << error.what();
  }
  for (const char* view : {"valley", "sunset", "limb"}) {
    const FrameOptions options = options_of(view, 96, 60);
    const double off =
        difference_of(renderer().draw(options).luminance, gpu->draw(options).luminance);
    std::printf("[    gpu ] %s: %.3f %% of the mean\n", view, 100 * off);
    EXPECT_LT(off, kAgreement) << view;
  }
  FrameOptions all = options_of("valley", 96, 60);
  all.shadows = true;
  all.clouds = {CloudLayer{}};
  all.second_sun = SecondSun{};
  all.moon = Moon{all.camera.view_zenith - 0.1, all.camera.azimuth, 50e3, 2e3, 0.3};
  const Frame a = draw_layers(all), b = draw_layers(all, *gpu);
  EXPECT_LT(difference_of(a.luminance, b.luminance), kAgreement);
  for (const auto& [name, layer] : {std::pair("in_scatter", &FrameLayers::in_scatter),
                                    {"reflected", &FrameLayers::reflected},
                                    {"direct", &FrameLayers::direct},
                                    {"transmittance", &FrameLayers::transmittance},
                                    {"normal", &FrameLayers::normal},
                                    {"albedo", &FrameLayers::albedo}}) {
    const double off = difference_of(*a.layers.*layer, *b.layers.*layer);
    std::printf("[    gpu ] %s: %.3f %%\n", name, 100 * off);
    EXPECT_LT(off, kAgreement) << name;
  }
}

TEST(Gpu, FramesThatStayOnTheDeviceAreTheSameWork) {
  const FrameOptions options = options_of("valley", 96, 60);
  const FrameStatistics read = renderer().draw(options).statistics,
                        unread = renderer().submit(options);
  EXPECT_GT(read.milliseconds, 0);
  EXPECT_EQ(unread.triangles, read.triangles);
  EXPECT_EQ(unread.blocks_drawn, read.blocks_drawn);
  ASSERT_EQ(unread.passes.size(), read.passes.size());
  for (std::size_t i = 0; i < read.passes.size(); ++i)
    EXPECT_EQ(unread.passes[i].pass, read.passes[i].pass);
  // The statistics come a frame later.
  const FrameOptions other = options_of("limb", 96, 60);
  EXPECT_EQ(renderer().submit(other).triangles, read.triangles);
  const FrameStatistics last = renderer().wait();
  EXPECT_EQ(last.triangles, renderer().draw(other).statistics.triangles);
  EXPECT_NE(last.triangles, read.triangles);
  EXPECT_GT(last.milliseconds, 0);
  EXPECT_THROW(renderer().wait(), std::logic_error);
  FrameOptions below = options;
  below.camera.altitude_m = -1e4;
  EXPECT_THROW(renderer().submit(below), std::invalid_argument);
}

// What a frame writes the one before may still read.
TEST(Gpu, FramesOnTheirWayDoNotDisturbEachOther) {
  const FrameOptions valley = options_of("valley", 96, 60), sunset = options_of("sunset", 96, 60);
  const std::vector<float> alone = renderer().draw(valley).luminance;
  for (int i = 0; i < 3; ++i) {
    renderer().submit(sunset);
    EXPECT_EQ(renderer().draw(valley).luminance, alone);
  }
}

}  // namespace
}  // namespace skyfit
