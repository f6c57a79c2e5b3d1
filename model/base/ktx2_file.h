// SPDX-License-Identifier: Apache-2.0
// Textures as files of Khronos Texture 2.0: one level of RGBA texels, signed floats of single or
// half precision with a linear transfer function, uncompressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace skyfit {

// Khronos Data Format 1.3, section 5.6: what R, G and B are.
enum class Ktx2Primaries : std::uint8_t { kNone = 0, kBt709 = 1, kBt2020 = 4, kCieXyz = 5 };

struct Ktx2Texture {
  std::uint32_t width = 0, height = 0;
  std::uint32_t depth = 0;  // 0: not a 3D texture
  // 6: a cube map, its faces +X, -X, +Y, -Y, +Z, -Z, each with its upper row first, in a
  // left-handed system: +Y up, and who looks along +Z has +X on the right.
  std::uint32_t faces = 1;
  bool half = false;
  Ktx2Primaries primaries = Ktx2Primaries::kNone;
  std::vector<std::pair<std::string, std::string>> metadata;  // beside KTXorientation
  std::span<const std::byte> texels;                          // [face][slice][row][column][4]
};

// The file appears whole or not at all; throws std::runtime_error that names it.
void write_ktx2_file(const std::filesystem::path& file, const Ktx2Texture& texture);

}  // namespace skyfit
