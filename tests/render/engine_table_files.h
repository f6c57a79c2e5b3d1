// SPDX-License-Identifier: Apache-2.0
// A folder of `skyfit tables`, and what files of DDS and Khronos Texture 2.0 hold.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "model/base/input_file.h"
#include "model/base/temporary_directory.h"
#include "render/engine/engine_tables.h"

namespace skyfit {

inline const TableFormatEntry& format_named(std::string_view name) {
  for (const TableFormatEntry& format : table_formats()) {
    if (format.name == name) return format;
  }
  throw std::logic_error("no such format");
}

// A folder that `skyfit tables` wrote.
struct Written {
  Written(const Preset& preset, const AtmosphereTables& tables, std::string_view format,
          TablePrecision precision)
      : engine(engine_tables(preset, tables, precision, Primaries::kRec709)) {
    write_engine_tables(engine, format_named(format), directory.path());
  }
  std::string text(const std::string& name) const {
    return read_file(directory.path() / name, "a file", std::size_t{1} << 28);
  }
  EngineTables engine;
  TemporaryDirectory directory;
};

template <class T>
T at(const std::string& bytes, std::size_t offset) {
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

// What the header of a file says, and the texels behind it.
struct FileTexels {
  std::uint32_t width, height, depth;
  bool half;
  std::string texels;
  std::uint32_t faces = 1;
  std::uint8_t primaries = 0;                                  // as Khronos numbers them
  std::vector<std::pair<std::string, std::string>> keys = {};  // with their values
};

inline FileTexels read_dds(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(0, 4), "DDS ");
  EXPECT_EQ(at<std::uint32_t>(bytes, 4), 124u);
  EXPECT_EQ(bytes.substr(84, 4), "DX10");
  const bool volume = at<std::uint32_t>(bytes, 132) == 4;  // D3D10_RESOURCE_DIMENSION_TEXTURE3D
  return {at<std::uint32_t>(bytes, 16), at<std::uint32_t>(bytes, 12),
          volume ? at<std::uint32_t>(bytes, 24) : 1, at<std::uint32_t>(bytes, 128) == 10,
          bytes.substr(148)};
}

inline FileTexels read_ktx2(const std::string& bytes) {
  EXPECT_EQ(bytes.substr(1, 6), "KTX 20");
  const auto depth = at<std::uint32_t>(bytes, 28);
  const auto offset = at<std::uint64_t>(bytes, 80), length = at<std::uint64_t>(bytes, 88);
  EXPECT_EQ(offset + length, bytes.size());
  // The parts of the header follow each other, and the texels are aligned to one.
  const auto format = at<std::uint32_t>(bytes, 48), keys = at<std::uint32_t>(bytes, 56),
             keys_end = keys + at<std::uint32_t>(bytes, 60);
  EXPECT_EQ(format, 104u);
  EXPECT_EQ(at<std::uint32_t>(bytes, format), at<std::uint32_t>(bytes, 52));
  EXPECT_EQ(keys, format + at<std::uint32_t>(bytes, 52));
  const std::uint32_t texel = 4 * at<std::uint32_t>(bytes, 16);
  EXPECT_EQ(offset % texel, 0u);
  EXPECT_LE(keys_end, offset);
  FileTexels file{at<std::uint32_t>(bytes, 20),
                  at<std::uint32_t>(bytes, 24),
                  std::max(depth, 1u),
                  at<std::uint32_t>(bytes, 12) == 97,
                  bytes.substr(offset),
                  at<std::uint32_t>(bytes, 36),
                  at<std::uint8_t>(bytes, format + 13)};
  for (std::uint32_t entry = keys; entry < keys_end;) {
    const auto size = at<std::uint32_t>(bytes, entry);
    const std::string both = bytes.substr(entry + 4, size);
    const std::size_t key = both.find('\0');
    EXPECT_EQ(both.back(), '\0');
    file.keys.emplace_back(both.substr(0, key), both.substr(key + 1, size - key - 2));
    entry += 4 + (size + 3) / 4 * 4;
  }
  return file;
}

}  // namespace skyfit
