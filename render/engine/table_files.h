// SPDX-License-Identifier: Apache-2.0
// Tables as files that engines read, RGBA in single or half precision. Each file appears whole or
// not at all; throws std::runtime_error that names it, and std::invalid_argument for texels of 8
// bits.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "model/tables/table_precision.h"

namespace skyfit {

// Microsoft's DirectDraw Surface with the header of Direct3D 10, 2D or 3D, without mipmaps.
void write_dds(const EncodedTable& table, const std::filesystem::path& file);

// Khronos Texture 2.0, uncompressed, 2D or 3D, without mipmaps.
void write_ktx2(const EncodedTable& table, const std::filesystem::path& file);

// (depth x height x width x 4), or (height x width x 4) of a 2D table.
void write_table_npy(const EncodedTable& table, const std::filesystem::path& file);

// OpenEXR with the channels R, G, B and A; the slices of a 3D table one below the other, the first
// on top.
void write_table_exr(const EncodedTable& table, const std::filesystem::path& file);

struct TableFormatEntry {
  std::string_view name;  // and extension
  void (*write)(const EncodedTable&, const std::filesystem::path&);
  std::string_view meaning;
};
std::span<const TableFormatEntry> table_formats();

}  // namespace skyfit
