// SPDX-License-Identifier: Apache-2.0
#include "render/engine/table_files.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <string>

#include "model/base/module_file.h"
#include "model/base/npy_file.h"
#include "model/base/whole_file.h"
#include "model/version.h"
#include "render/module/module.h"

namespace skyfit {
namespace {

static_assert(std::endian::native == std::endian::little);

template <class... Integers>
void append(std::string& bytes, Integers... values) {
  const auto one = [&](auto value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  (one(values), ...);
}

void append(std::string& bytes, const EncodedTable& table) {
  bytes.append(reinterpret_cast<const char*>(table.texels.data()), table.texels.size());
}

bool is_half(const EncodedTable& table, const std::filesystem::path& file) {
  if (table.precision == TablePrecision::k8Bit)
    throw std::invalid_argument(
        fmt::format("{}: expected a table of float or half", file.string()));
  return table.precision == TablePrecision::kHalf;
}

std::uint32_t unsigned_of(int size) { return static_cast<std::uint32_t>(size); }

// The Khronos Data Format's basic descriptor block, 1.3, of four channels of signed floats.
std::string data_format(std::uint32_t texel_bytes) {
  constexpr std::uint32_t kChannels = 4, kBlock = 24 + 16 * kChannels, kVersion = 2;
  constexpr std::uint32_t kRgb = 1, kLinear = 1;  // color model, transfer function
  constexpr std::uint8_t kSignedFloat = 0xC0;
  std::string bytes;
  append(bytes, 4 + kBlock, std::uint32_t{0}, kVersion | kBlock << 16, kRgb | kLinear << 16,
         std::uint32_t{0}, texel_bytes, std::uint32_t{0});
  const std::uint32_t bits = 8 * texel_bytes / kChannels;
  constexpr std::array<std::uint8_t, kChannels> kNames = {0, 1, 2, 15};
  for (std::uint32_t c = 0; c < kChannels; ++c) {
    append(bytes, static_cast<std::uint16_t>(c * bits), static_cast<std::uint8_t>(bits - 1),
           static_cast<std::uint8_t>(kSignedFloat | kNames[c]), std::uint32_t{0},
           std::bit_cast<std::uint32_t>(-1.0f), std::bit_cast<std::uint32_t>(1.0f));
  }
  return bytes;
}

std::string key_and_value(std::string_view key, std::string_view value) {
  std::string entry;
  append(entry, static_cast<std::uint32_t>(key.size() + value.size() + 2));
  entry.append(key).append(1, '\0').append(value).append(1, '\0');
  entry.append((4 - entry.size() % 4) % 4, '\0');
  return entry;
}

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
  append(
      bytes, std::uint32_t{124}, kCaps | kHeight | kWidth | kPitch | kFormat | (flat ? 0 : kDepth),
      unsigned_of(table.height), width, row, flat ? 0 : unsigned_of(table.depth), std::uint32_t{1});
  bytes.append(11 * sizeof(std::uint32_t), '\0');
  append(bytes, std::uint32_t{32}, kFourCharacters, kDx10);
  bytes.append(5 * sizeof(std::uint32_t), '\0');
  append(bytes, flat ? kTexture : kTexture | kComplex, flat ? 0 : kVolume);
  bytes.append(3 * sizeof(std::uint32_t), '\0');
  append(bytes, half ? kHalves : kFloats, flat ? k2D : k3D, std::uint32_t{0}, kOneTexture,
         std::uint32_t{0});
  append(bytes, table);
  write_whole_file(file, bytes);
}

void write_ktx2(const EncodedTable& table, const std::filesystem::path& file) {
  constexpr std::uint32_t kHalves = 97, kFloats = 109;  // VK_FORMAT_R16G16B16A16_SFLOAT, R32..
  const bool half = is_half(table, file), flat = table.depth <= 1;
  const auto texel = static_cast<std::uint32_t>(bytes_of_texel(table.precision));
  std::string bytes("\xABKTX 20\xBB\r\n\x1A\n", 12);
  append(bytes, half ? kHalves : kFloats, texel / 4, unsigned_of(table.width),
         unsigned_of(table.height), flat ? 0 : unsigned_of(table.depth));
  constexpr std::uint32_t kLayers = 0, kFaces = 1, kLevels = 1, kCompression = 0;
  append(bytes, kLayers, kFaces, kLevels, kCompression);
  const std::string format = data_format(texel),
                    keys = key_and_value("KTXorientation", flat ? "rd" : "rdi") +
                           key_and_value("KTXwriter", fmt::format("skyfit {}", kVersion));
  constexpr std::uint32_t kIndex = 80 + 24;  // end of the header with one level
  const auto after = [](std::uint32_t begin, const std::string& part) {
    return begin + static_cast<std::uint32_t>(part.size());
  };
  const std::uint32_t keys_at = after(kIndex, format), end = after(keys_at, keys),
                      texels_at = (end + texel - 1) / texel * texel;
  append(bytes, kIndex, static_cast<std::uint32_t>(format.size()), keys_at,
         static_cast<std::uint32_t>(keys.size()), std::uint64_t{0}, std::uint64_t{0});
  append(bytes, std::uint64_t{texels_at}, std::uint64_t{table.texels.size()},
         std::uint64_t{table.texels.size()});
  bytes += format + keys;
  bytes.append(texels_at - end, '\0');
  append(bytes, table);
  write_whole_file(file, bytes);
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
