// SPDX-License-Identifier: Apache-2.0
// Three pictures as they were when somebody looked at them: what no property test notices, a wrong
// horizon, a seam or another mood. A picture that differs is left in the folder for temporary
// files; when it is right, it takes the old one's place in tests/render/data/.
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

// Other drivers put the edges of triangles elsewhere and round differently.
constexpr double kMeanDifference = 0.7;  // of 255
constexpr int kEdge = 12;                // of 255
constexpr double kEdges = 0.02;          // share of the values

std::vector<std::uint8_t> pixels_of(const std::filesystem::path& file) {
  const auto input = OIIO::ImageInput::open(file.string());
  if (!input) throw std::runtime_error(file.string() + ": " + OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(spec.width) * spec.height * 3);
  if (!input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()))
    throw std::runtime_error(file.string() + ": " + input->geterror());
  return pixels;
}

class Golden : public ::testing::TestWithParam<const char*> {};

TEST_P(Golden, PictureIsAsItWas) {
  FrameOptions options = options_of(GetParam(), 160, 90);
  options.samples_per_side = 2;
  const std::string name = std::string(GetParam()) + ".png";
  const auto drawn = std::filesystem::temp_directory_path() / ("skyfit_drawn_" + name);
  write_png(renderer().draw(options), drawn);
  const std::vector<std::uint8_t> now = pixels_of(drawn);
  const std::vector<std::uint8_t> then = pixels_of(std::filesystem::path(SKYFIT_TEST_DATA) / name);
  ASSERT_EQ(now.size(), then.size());
  const auto count = static_cast<double>(now.size());
  double mean = 0, edges = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const int difference = std::abs(now[i] - then[i]);
    mean += difference / count;
    if (difference > kEdge) edges += 1 / count;
  }
  std::printf("[ golden ] %s: mean difference %.3f of 255, %.2f %% above %d\n", GetParam(), mean,
              100 * edges, kEdge);
  EXPECT_LT(mean, kMeanDifference) << "drawn: " << drawn;
  EXPECT_LT(edges, kEdges) << "drawn: " << drawn;
  if (!HasFailure()) std::filesystem::remove(drawn);
}

INSTANTIATE_TEST_SUITE_P(Views, Golden, ::testing::Values("valley", "sunset", "limb"));

}  // namespace
}  // namespace skyfit
