// SPDX-License-Identifier: Apache-2.0
// A folder of `skyfit tables`, and what its DDS files hold.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>

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

}  // namespace skyfit
