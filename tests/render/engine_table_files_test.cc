// SPDX-License-Identifier: Apache-2.0
// The files of `skyfit tables` hold the texels in every format, and precisions round to the
// nearest.
#include "tests/render/engine_table_files.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "model/tables/table_precision.h"
#include "tests/render/gl_fixture.h"

namespace skyfit {
namespace {

FileTexels read_npy(const std::string& bytes) {
  const std::size_t begin = 10 + at<std::uint16_t>(bytes, 8);
  const std::string header = bytes.substr(10, begin - 10);
  std::vector<std::uint32_t> shape;
  for (std::size_t i = header.find('(') + 1; i < header.find(')');) {
    shape.push_back(static_cast<std::uint32_t>(std::stoul(header.substr(i))));
    i = header.find(',', i) + 2;
  }
  EXPECT_EQ(shape.back(), 4u);
  const std::size_t last = shape.size() - 1;
  return {shape[last - 1], shape[last - 2], last > 2 ? shape[0] : 1,
          header.find("<f2") != std::string::npos, bytes.substr(begin)};
}

void expect_texels(const FileTexels& file, const EncodedTable& table, const std::string& what) {
  EXPECT_EQ(file.width, static_cast<std::uint32_t>(table.width)) << what;
  EXPECT_EQ(file.height, static_cast<std::uint32_t>(table.height)) << what;
  EXPECT_EQ(file.depth, static_cast<std::uint32_t>(table.depth)) << what;
  EXPECT_EQ(file.half, table.precision == TablePrecision::kHalf) << what;
  ASSERT_EQ(file.texels.size(), table.texels.size()) << what;
  EXPECT_EQ(std::memcmp(file.texels.data(), table.texels.data(), table.texels.size()), 0) << what;
}

TEST(EngineTables, FilesHoldTheTexels) {
  static const AtmosphereTables tables =
      tables_of(shipped("earth-clear"), {16, 16, 8, 4, 4, 4, 8, 8, 4, 8, 8, 4});
  // Of both precisions: the small tables are floats.
  constexpr TablePrecision precision = TablePrecision::kHalf;
  const Preset preset = shipped("earth-clear");
  const Written dds(preset, tables, "dds", precision), ktx2(preset, tables, "ktx2", precision),
      npy(preset, tables, "npy", precision), exr(preset, tables, "exr", precision);
  for (const EngineTable& table : dds.engine.tables) {
    const std::string name(table.name);
    expect_texels(read_dds(dds.text(name + ".dds")), table.texels, name + ".dds");
    expect_texels(read_ktx2(ktx2.text(name + ".ktx2")), table.texels, name + ".ktx2");
    expect_texels(read_npy(npy.text(name + ".npy")), table.texels, name + ".npy");
    const auto image = OIIO::ImageInput::open(exr.directory.path() / (name + ".exr"));
    ASSERT_TRUE(image) << name;
    const OIIO::ImageSpec& spec = image->spec();
    const bool half = spec.format == OIIO::TypeDesc::HALF;
    std::string texels(table.texels.texels.size(), '\0');
    ASSERT_EQ(spec.image_bytes(true), texels.size()) << name;
    image->read_image(0, 0, 0, 4, spec.format, texels.data());
    expect_texels({static_cast<std::uint32_t>(spec.width),
                   static_cast<std::uint32_t>(spec.height / table.texels.depth),
                   static_cast<std::uint32_t>(table.texels.depth), half, texels},
                  table.texels, name + ".exr");
  }
}

TEST(EngineTables, EightBitsAreNoFileOfAnEngine) {
  const EncodedTable table{1, 1, 1, TablePrecision::k8Bit, {}, std::vector<std::byte>(4)};
  const TemporaryDirectory directory;
  for (const TableFormatEntry& format : table_formats())
    EXPECT_THROW(format.write(table, directory.path() / "x"), std::invalid_argument) << format.name;
}

TEST(TablePrecisions, RoundToTheNearest) {
  Table table{8, 4, 1, {}};
  for (int i = 0; i < 128; ++i) table.rgba.push_back(-20.0f + 0.15f * static_cast<float>(i));
  const float high = table.rgba.back(), range = high - table.rgba.front();
  const Table same = decoded(encoded(table, TableHolds::kLogarithms, TablePrecision::kFloat)),
              half = decoded(encoded(table, TableHolds::kLogarithms, TablePrecision::kHalf)),
              steps = decoded(encoded(table, TableHolds::kLogarithms, TablePrecision::k8Bit)),
              shares = decoded(encoded(table, TableHolds::kValues, TablePrecision::k8Bit));
  EXPECT_EQ(same.rgba, table.rgba);
  EXPECT_EQ(steps.rgba, shares.rgba);
  constexpr float kHalfUnit = 1.0f / 2048, kStep = 1.0f / 255, kRounding = 4e-6f;
  for (std::size_t i = 0; i < table.rgba.size(); ++i) {
    EXPECT_LE(std::abs(half.rgba[i] - table.rgba[i]),
              kHalfUnit * (high - table.rgba[i]) + kRounding);
    EXPECT_LE(std::abs(steps.rgba[i] - table.rgba[i]), 0.5f * kStep * range + kRounding);
  }
  EXPECT_EQ(half.rgba.back(), high);
  EXPECT_NEAR(steps.rgba.front(), table.rgba.front(), kRounding);
  // Values keep their ratios in half precision, from the largest to a hundred millionth of it.
  for (std::size_t i = 0; i < table.rgba.size(); ++i) table.rgba[i] = std::exp(table.rgba[i]);
  const Table ratios = decoded(encoded(table, TableHolds::kValues, TablePrecision::kHalf));
  for (std::size_t i = 0; i < table.rgba.size(); ++i)
    EXPECT_NEAR(ratios.rgba[i] / table.rgba[i], 1, 1.01 * kHalfUnit);
}

}  // namespace
}  // namespace skyfit
