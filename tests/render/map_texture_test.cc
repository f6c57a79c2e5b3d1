// SPDX-License-Identifier: Apache-2.0
// A map of all directions as Khronos Texture 2.0 has the pixels of the map as .npy: of a cube, what
// a look-up in a direction gives in the left-handed axes of that format.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <random>

#include "render/image/image_files.h"
#include "tests/render/engine_table_files.h"

namespace skyfit {
namespace {

constexpr int kSize = 16;

// Every pixel another colour, within all primaries.
SkyMap map_of(const MapProjection& projection) {
  SkyMap map;
  map.width = projection.width();
  map.height = projection.height();
  map.faces = projection.faces();
  map.channels = {"X", "Y", "Z"};
  map.is_xyz = true;
  map.metadata = {{"skyfit:unit", "cd/m^2"}, {"skyfit:altitude_m", "12"}};
  for (int i = 0; i < map.width * map.height; ++i) {
    const auto light = static_cast<float>(1 + i);
    map.pixels.insert(map.pixels.end(), {0.95f * light, light, 1.08f * light});
  }
  return map;
}

struct WrittenMap {
  FileTexels texture;
  std::vector<float> npy;  // [row][column][3]
};

std::string bytes_of(const std::filesystem::path& file) {
  return read_file(file, "a file", std::size_t{1} << 24);
}

std::vector<float> floats_of(const std::string& bytes) {
  std::vector<float> floats(bytes.size() / sizeof(float));
  std::memcpy(floats.data(), bytes.data(), bytes.size());
  return floats;
}

WrittenMap written(const SkyMap& map, Primaries primaries) {
  const TemporaryDirectory directory;
  const auto ktx2 = directory.path() / "sky.ktx2", npy = directory.path() / "sky.npy";
  write_map_file(map, primaries, ktx2);
  write_map_file(map, primaries, npy);
  const std::string array = bytes_of(npy);
  return {read_ktx2(bytes_of(ktx2)), floats_of(array.substr(10 + at<std::uint16_t>(array, 8)))};
}

TEST(MapTexture, HasThePixelsOfTheMap) {
  const SkyMap map = map_of(*make_map_projection("equirectangular", kSize));
  for (const auto& [primaries, number] :
       {std::pair{Primaries::kRec709, 1}, {Primaries::kRec2020, 4}, {Primaries::kXyz, 5}}) {
    const auto [texture, npy] = written(map, primaries);
    EXPECT_EQ(texture.width, static_cast<std::uint32_t>(map.width));
    EXPECT_EQ(texture.height, static_cast<std::uint32_t>(map.height));
    EXPECT_EQ(texture.faces, 1u);
    EXPECT_FALSE(texture.half);
    EXPECT_EQ(texture.primaries, number);
    const std::vector<float> texels = floats_of(texture.texels);
    ASSERT_EQ(texels.size() / 4, npy.size() / 3);
    for (std::size_t i = 0; i < npy.size() / 3; ++i) {
      for (std::size_t c = 0; c < 3; ++c) ASSERT_EQ(texels[4 * i + c], npy[3 * i + c]);
      ASSERT_EQ(texels[4 * i + 3], 1);
    }
  }
}

// Column and row of a face of `side` texels for a direction, as OpenGL's and Vulkan's table of
// cube maps says, and the face.
std::array<int, 3> texel_in(double x, double y, double z, int side) {
  int face;
  double s, t, major;
  if (std::abs(x) > std::max(std::abs(y), std::abs(z))) {
    face = x > 0 ? 0 : 1, s = x > 0 ? -z : z, t = -y, major = std::abs(x);
  } else if (std::abs(y) > std::abs(z)) {
    face = y > 0 ? 2 : 3, s = x, t = y > 0 ? z : -z, major = std::abs(y);
  } else {
    face = z > 0 ? 4 : 5, s = z > 0 ? x : -x, t = -y, major = std::abs(z);
  }
  const auto place = [&](double at) { return static_cast<int>(side * 0.5 * (at / major + 1)); };
  return {place(s), place(t), face};
}

TEST(MapTexture, OfACubeIsACubeMapWhoseAxesAreEastUpAndNorth) {
  const auto projection = make_map_projection("cube", kSize);
  const auto [texture, npy] = written(map_of(*projection), Primaries::kRec709);
  EXPECT_EQ(texture.width, static_cast<std::uint32_t>(kSize));
  EXPECT_EQ(texture.height, static_cast<std::uint32_t>(kSize));
  EXPECT_EQ(texture.faces, 6u);
  const std::vector<float> texels = floats_of(texture.texels);
  ASSERT_EQ(texels.size(), std::size_t{4} * 6 * kSize * kSize);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 5000; ++i) {
    const Axis d = {normal(random), normal(random), normal(random)};
    const auto [column, row, face] = texel_in(d[0], d[2], d[1], kSize);
    const auto of_map = *projection->point(d);
    const auto pixel = static_cast<std::size_t>(of_map[1]) * projection->width() +
                       static_cast<std::size_t>(of_map[0]);
    const auto texel = static_cast<std::size_t>((face * kSize + row) * kSize + column);
    ASSERT_EQ(texels[4 * texel], npy[3 * pixel]) << d[0] << " " << d[1] << " " << d[2];
  }
}

TEST(MapTexture, TellsItsMetadataInTheOrderOfTheKeys) {
  const SkyMap map = map_of(*make_map_projection("angular", kSize));
  const auto keys = written(map, Primaries::kRec709).texture.keys;
  ASSERT_EQ(keys.size(), 4u);
  EXPECT_EQ(keys[0], std::pair(std::string("KTXorientation"), std::string("rd")));
  EXPECT_EQ(keys[1].first, "KTXwriter");
  EXPECT_EQ(keys[1].second.substr(0, 7), "skyfit ");
  EXPECT_EQ(keys[2], map.metadata[1]);
  EXPECT_EQ(keys[3], map.metadata[0]);
}

}  // namespace
}  // namespace skyfit
