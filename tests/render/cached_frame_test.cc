// SPDX-License-Identifier: Apache-2.0
// A frame whose ground and textures come from a cache is bit for bit the one whose ground is made:
// for a made-up planet and for one of maps, and after the map has changed.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/render/frame_fixture.h"
#include "tests/render/map_fixture.h"

namespace skyfit {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 48, kHeight = 32;

using CachedFrame = MapFiles;

Frame drawn(const Scene& scene, const std::shared_ptr<ContentCache>& cache) {
  FrameOptions options = options_of("valley", kWidth, kHeight);
  if (!scene.height_map.empty()) options.camera.altitude_m = 9e3;
  return make_renderer(scene, GraphicsDevice::kSoftware, cache).draw(options);
}

std::shared_ptr<ContentCache> cache_in(const fs::path& folder) {
  return std::make_shared<ContentCache>(folder / "skyfit");
}

void expect_same(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.rgb, b.rgb);
  EXPECT_EQ(a.luminance, b.luminance);
  EXPECT_EQ(a.depth_m, b.depth_m);
}

std::set<fs::path> entries(const fs::path& folder) {
  const fs::directory_iterator files(folder / "skyfit");
  std::set<fs::path> names;
  for (const auto& file : files) {
    if (file.is_regular_file()) names.insert(file.path());
  }
  return names;
}

TEST_F(CachedFrame, OfAMadeUpPlanetIsTheSame) {
  const TemporaryDirectory folder;
  const Frame without = drawn({}, nullptr);
  expect_same(drawn({}, cache_in(folder.path())), without);
  const std::set<fs::path> kept = entries(folder.path());
  EXPECT_GT(kept.size(), 20u) << "families of blocks";
  expect_same(drawn({}, cache_in(folder.path())), without);
  EXPECT_EQ(entries(folder.path()), kept) << "all was found";
}

TEST_F(CachedFrame, OfMapsIsTheSameUntilTheyChange) {
  const TemporaryDirectory folder;
  constexpr int kRows = 16;
  Scene scene;
  const auto heights = [&](std::size_t seed) {
    std::vector<float> values = noise(2 * kRows * kRows);
    std::rotate(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(seed), values.end());
    scene.height_map = write("heights.tif", 2 * kRows, kRows, 1, OIIO::TypeDesc::UINT16, values);
  };
  heights(0);
  const Frame before = drawn(scene, cache_in(folder.path()));
  expect_same(drawn(scene, cache_in(folder.path())), before);
  heights(kRows);  // under the same name
  const Frame after = drawn(scene, cache_in(folder.path()));
  EXPECT_NE(after.depth_m, before.depth_m);
  expect_same(after, drawn(scene, nullptr));
}

}  // namespace
}  // namespace skyfit
