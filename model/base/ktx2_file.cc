// SPDX-License-Identifier: Apache-2.0
#include "model/base/ktx2_file.h"

#include <algorithm>
#include <array>
#include <bit>

#include "model/base/little_endian.h"
#include "model/base/whole_file.h"

namespace skyfit {
namespace {

// The Khronos Data Format's basic descriptor block, 1.3, of four channels of signed floats.
std::string data_format(std::uint32_t texel_bytes, Ktx2Primaries primaries) {
  constexpr std::uint32_t kChannels = 4, kBlock = 24 + 16 * kChannels, kVersion = 2;
  constexpr std::uint32_t kRgb = 1, kLinear = 1;  // color model, transfer function
  constexpr std::uint8_t kSignedFloat = 0xC0;
  std::string bytes;
  append_numbers(bytes, 4 + kBlock, std::uint32_t{0}, kVersion | kBlock << 16,
                 kRgb | static_cast<std::uint32_t>(primaries) << 8 | kLinear << 16,
                 std::uint32_t{0}, texel_bytes, std::uint32_t{0});
  const std::uint32_t bits = 8 * texel_bytes / kChannels;
  constexpr std::array<std::uint8_t, kChannels> kNames = {0, 1, 2, 15};
  for (std::uint32_t c = 0; c < kChannels; ++c) {
    append_numbers(bytes, static_cast<std::uint16_t>(c * bits), static_cast<std::uint8_t>(bits - 1),
                   static_cast<std::uint8_t>(kSignedFloat | kNames[c]), std::uint32_t{0},
                   std::bit_cast<std::uint32_t>(-1.0f), std::bit_cast<std::uint32_t>(1.0f));
  }
  return bytes;
}

// In the order of their keys' bytes, as the format wants them.
std::string keys_and_values(const Ktx2Texture& texture) {
  auto entries = texture.metadata;
  entries.emplace_back("KTXorientation", texture.depth == 0 ? "rd" : "rdi");
  std::ranges::sort(entries);
  std::string bytes;
  for (const auto& [key, value] : entries) {
    append_numbers(bytes, static_cast<std::uint32_t>(key.size() + value.size() + 2));
    bytes.append(key).append(1, '\0').append(value).append(1, '\0');
    bytes.append((4 - bytes.size() % 4) % 4, '\0');
  }
  return bytes;
}

}  // namespace

void write_ktx2_file(const std::filesystem::path& file, const Ktx2Texture& texture) {
  constexpr std::uint32_t kHalves = 97, kFloats = 109;  // VK_FORMAT_R16G16B16A16_SFLOAT, R32..
  const std::uint32_t component = texture.half ? 2 : 4, texel = 4 * component;
  std::string bytes("\xABKTX 20\xBB\r\n\x1A\n", 12);
  append_numbers(bytes, texture.half ? kHalves : kFloats, component, texture.width, texture.height,
                 texture.depth);
  constexpr std::uint32_t kLayers = 0, kLevels = 1, kCompression = 0;
  append_numbers(bytes, kLayers, texture.faces, kLevels, kCompression);
  const std::string format = data_format(texel, texture.primaries), keys = keys_and_values(texture);
  constexpr std::uint32_t kIndex = 80 + 24;  // end of the header with one level
  const auto after = [](std::uint32_t begin, const std::string& part) {
    return begin + static_cast<std::uint32_t>(part.size());
  };
  const std::uint32_t keys_at = after(kIndex, format), end = after(keys_at, keys),
                      texels_at = (end + texel - 1) / texel * texel;
  append_numbers(bytes, kIndex, static_cast<std::uint32_t>(format.size()), keys_at,
                 static_cast<std::uint32_t>(keys.size()), std::uint64_t{0}, std::uint64_t{0});
  append_numbers(bytes, std::uint64_t{texels_at}, std::uint64_t{texture.texels.size()},
                 std::uint64_t{texture.texels.size()});
  bytes += format + keys;
  bytes.append(texels_at - end, '\0');
  bytes.append(reinterpret_cast<const char*>(texture.texels.data()), texture.texels.size());
  write_whole_file(file, bytes);
}

}  // namespace skyfit
