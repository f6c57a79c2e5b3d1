// SPDX-License-Identifier: Apache-2.0
#include "render/engine/table_files.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "model/base/ktx2_file.h"
#include "model/base/little_endian.h"
#include "model/base/module_file.h"
#include "model/base/npy_file.h"
#include "model/base/whole_file.h"
#include "model/version.h"
#include "render/module/module.h"

namespace skyfit {
namespace {

bool is_half(const EncodedTable& table, const std::filesystem::path& file) {
  if (table.precision == TablePrecision::k8Bit)
    throw std::invalid_argument(
        fmt::format("{}: expected a table of float or half", file.string()));
  return table.precision == TablePrecision::kHalf;
}

std::uint32_t unsigned_of(int size) { return static_cast<std::uint32_t>(size); }

}  // namespace

void write_dds(const EncodedTable& table, const std::filesystem::path& file) {
  constexpr std::uint32_t kCaps = 0x1, kHeight = 0x2, kWidth = 0x4, kPitch = 0x8, kFormat = 0x1000,
                          kDepth = 0x800000;
  constexpr std::uint32_t kFourCharacters = 0x4, kDx10 = 0x30315844;  // "DX10"
  constexpr std::uint32_t kComplex = 0x8, kTexture = 0x1000, kVolume = 0x200000;
  constexpr std::uint32_t kFloats = 2, kHalves = 10;  // DXGI_FORMAT_R32G32B32A32_FLOAT, R16..
  constexpr std::uint32_t k2D = 3, k3D = 4, kOneTexture = 1;
  const bool half = is_half(table, file), flat = table.depth <= 1;
  const auto width = unsigned_of(table.width),
             row = width * static_cast<std::uint32_t>(bytes_of_texel(table.precision));
  std::string bytes = "DDS ";
  append_numbers(
      bytes, std::uint32_t{124}, kCaps | kHeight | kWidth | kPitch | kFormat | (flat ? 0 : kDepth),
      unsigned_of(table.height), width, row, flat ? 0 : unsigned_of(table.depth), std::uint32_t{1});
  bytes.append(11 * sizeof(std::uint32_t), '\0');
  append_numbers(bytes, std::uint32_t{32}, kFourCharacters, kDx10);
  bytes.append(5 * sizeof(std::uint32_t), '\0');
  append_numbers(bytes, flat ? kTexture : kTexture | kComplex, flat ? 0 : kVolume);
  bytes.append(3 * sizeof(std::uint32_t), '\0');
  append_numbers(bytes, half ? kHalves : kFloats, flat ? k2D : k3D, std::uint32_t{0}, kOneTexture,
                 std::uint32_t{0});
  bytes.append(reinterpret_cast<const char*>(table.texels.data()), table.texels.size());
  write_whole_file(file, bytes);
}

void write_ktx2(const EncodedTable& table, const std::filesystem::path& file) {
  write_ktx2_file(file, {.width = unsigned_of(table.width),
                         .height = unsigned_of(table.height),
                         .depth = table.depth <= 1 ? 0 : unsigned_of(table.depth),
                         .half = is_half(table, file),
                         .metadata = {{"KTXwriter", fmt::format("skyfit {}", kVersion)}},
                         .texels = table.texels});
}

void write_table_npy(const EncodedTable& table, const std::filesystem::path& file) {
  const bool half = is_half(table, file);
  std::vector<std::size_t> shape = {static_cast<std::size_t>(table.height),
                                    static_cast<std::size_t>(table.width), 4};
  if (table.depth > 1) shape.insert(shape.begin(), static_cast<std::size_t>(table.depth));
  write_npy_bytes(file, shape, half ? "<f2" : "<f4", half ? 2 : 4, table.texels);
}

void write_table_exr(const EncodedTable& table, const std::filesystem::path& file) {
  is_half(table, file);
  module_named<RenderModule>("skyfit_render_module").write_table(table, file);
}

std::span<const TableFormatEntry> table_formats() {
  static constexpr std::array kFormats = {
      TableFormatEntry{"exr", write_table_exr, "OpenEXR, slices of 3D tables one below the other"},
      TableFormatEntry{"dds", write_dds, "DirectDraw Surface with the header of Direct3D 10"},
      TableFormatEntry{"npy", write_table_npy, "array of NumPy, (depth, height, width, 4)"},
      TableFormatEntry{"ktx2", write_ktx2, "Khronos Texture 2.0, uncompressed"}};
  return kFormats;
}

}  // namespace skyfit
