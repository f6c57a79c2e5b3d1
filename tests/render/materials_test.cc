// SPDX-License-Identifier: Apache-2.0
// The materials' textures are saved and read back as they are, repeat without a seam and have the
// mean that leaves the ground's reflectance alone.
#include "render/gl/terrain/materials.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "tests/render/frame_fixture.h"

namespace skyfit {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kSide = kMaterialSide;

class EveryMaterial : public ::testing::TestWithParam<Texture> {};

TEST_P(EveryMaterial, IsReadBackAsItWasSaved) {
  const TemporaryDirectory directory;
  const MaterialTexels made = load_texture(GetParam(), directory.path());
  const auto file =
      directory.path() / (GetParam() == Texture::kGrains ? "grains.png" : "crags.png");
  ASSERT_TRUE(std::filesystem::exists(file));
  const auto written = std::filesystem::last_write_time(file);
  EXPECT_EQ(load_texture(GetParam(), directory.path()), made);
  EXPECT_EQ(std::filesystem::last_write_time(file), written);  // not made again
  EXPECT_EQ(make_texture(GetParam()), made);
  EXPECT_EQ(load_texture(GetParam(), {}), made);
}

TEST_P(EveryMaterial, RepeatsWithoutASeam) {
  const MaterialTexels texels = make_texture(GetParam());
  // Mean square step to the next layer along each axis: across the wrap no more than somewhere
  // else.
  for (int axis = 0; axis < 3; ++axis) {
    std::array<double, kSide> steps{};
    for (int a = 0; a < kSide; ++a) {
      for (int b = 0; b < kSide; ++b) {
        for (int at = 0; at < kSide; ++at) {
          const auto texel = [&](int c) {
            std::array<int, 3> p{};
            p[static_cast<std::size_t>(axis)] = c % kSide;
            p[static_cast<std::size_t>((axis + 1) % 3)] = a;
            p[static_cast<std::size_t>((axis + 2) % 3)] = b;
            return 4 * ((static_cast<std::size_t>(p[2]) * kSide + p[1]) * kSide + p[0]);
          };
          for (std::size_t k = 0; k < 4; ++k) {
            const double step = double{1} * texels[texel(at) + k] - texels[texel(at + 1) + k];
            steps[static_cast<std::size_t>(at)] += step * step / (4 * kSide * kSide);
          }
        }
      }
    }
    const double inside = *std::max_element(steps.begin(), steps.end() - 1);
    std::printf("[  steps ] axis %d: %.2f across the wrap, up to %.2f inside (rms, of 255)\n", axis,
                std::sqrt(steps.back()), std::sqrt(inside));
    constexpr double kLayersDiffer = 1.1;
    EXPECT_LT(steps.back(), kLayersDiffer * inside);
  }
}

TEST_P(EveryMaterial, NeitherDarkensNorTiltsTheGround) {
  const std::vector<MaterialTexels> mipmaps = mipmaps_of(make_texture(GetParam()));
  ASSERT_EQ(mipmaps.size(), 7u);
  for (const MaterialTexels& texels : mipmaps) {
    const double count = static_cast<double>(texels.size()) / 4;
    glm::dvec4 mean(0);
    for (std::size_t i = 0; i < texels.size(); i += 4) {
      for (int k = 0; k < 4; ++k) mean[k] += texels[i + static_cast<std::size_t>(k)] / count;
    }
    // Rounding has no direction, but a texel's own share of half a step.
    const double rounding = 0.1 + 0.5 / std::sqrt(count);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(mean[k], 127, rounding) << count << " texels";
    EXPECT_NEAR(mean[3] / 127.5, 1, 0.01 + rounding / 127.5);  // clamped at three deviations
  }
  EXPECT_EQ(mipmaps.back().size(), 4u);
}

// So that where grains are no longer looked up nothing of them is left.
TEST_P(EveryMaterial, FadesToItsMeanBeforeTheLastMipmap) {
  const std::vector<MaterialTexels> mipmaps = mipmaps_of(make_texture(GetParam()));
  const MaterialTexels& two = mipmaps[5];
  ASSERT_EQ(two.size(), 4u * 8);
  for (std::size_t i = 0; i < two.size(); ++i) EXPECT_EQ(two[i], mipmaps.back()[i % 4]);
  const auto [low, high] = std::minmax_element(mipmaps[4].begin(), mipmaps[4].end());
  EXPECT_LT(*low, *high);
  // The mipmap whose texels are a pixel at that distance, seen head on.
  constexpr double kPixel = 1e-3, kGrainUnit = 1.5;
  EXPECT_NEAR(Materials::grainless_distance_m(kPixel) * kPixel * kSide / kGrainUnit, std::exp2(5.0),
              1e-9);
}

TEST_P(EveryMaterial, OfAnotherSizeIsRefusedInOneLine) {
  const TemporaryDirectory directory;
  const auto file =
      directory.path() / (GetParam() == Texture::kGrains ? "grains.png" : "crags.png");
  const OIIO::ImageSpec spec(8, 4, 3, OIIO::TypeDesc::UINT8);
  const std::vector<std::uint8_t> pixels(8 * 4 * 3, 100);
  const auto output = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(output && output->open(file.string(), spec) &&
              output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) && output->close());
  Scene scene;
  scene.textures = directory.path();
  try {
    Renderer made(scene);
    made.set_atmosphere(earth_clear(), small_tables());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_STREQ(error.what(), (file.string() + ": 8 x 4 pixels of 3 channels: a texture has 64 x "
                                                "4096 of 4")
                                   .c_str());
  }
}

TEST_P(EveryMaterial, ThatIsNoPictureIsRefusedInOneLine) {
  const TemporaryDirectory directory;
  const auto file =
      directory.path() / (GetParam() == Texture::kGrains ? "grains.png" : "crags.png");
  std::ofstream(file) << "not a picture";
  try {
    load_texture(GetParam(), directory.path());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(file.string() + ": cannot read"));
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
  }
}

// A pipe may never end.
TEST_P(EveryMaterial, ThatIsAPipeIsRefusedInOneLine) {
  const TemporaryDirectory directory;
  const auto file =
      directory.path() / (GetParam() == Texture::kGrains ? "grains.png" : "crags.png");
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  try {
    load_texture(GetParam(), directory.path());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), file.string() +
                                ": cannot be read (it is a pipe or a device), expected "
                                "a texture of the ground (PNG)");
  }
}

INSTANTIATE_TEST_SUITE_P(Materials, EveryMaterial,
                         ::testing::Values(Texture::kGrains, Texture::kCrags));

}  // namespace
}  // namespace skyfit
