// SPDX-License-Identifier: Apache-2.0
#include "render/image/map_texture.h"

#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <stdexcept>

#include "model/base/ktx2_file.h"
#include "model/version.h"

namespace skyfit {
namespace {

// Where a face of the file comes from. A cube map's axes are left-handed and OpenGL's, in which a
// map has its cube, are right-handed: +Z is north here and south there, so that a face that shows
// either horizon is turned left to right, and those above and below the other way.
struct CubeMapFace {
  int of_map;
  bool right_to_left, upside_down;
};
constexpr std::array<CubeMapFace, 6> kCubeMapFaces = {{{0, true, false},
                                                       {1, true, false},
                                                       {2, false, true},
                                                       {3, false, true},
                                                       {5, true, false},
                                                       {4, true, false}}};

Ktx2Primaries ktx2_primaries(Primaries primaries) {
  switch (primaries) {
    case Primaries::kRec709:
      return Ktx2Primaries::kBt709;
    case Primaries::kRec2020:
      return Ktx2Primaries::kBt2020;
    case Primaries::kXyz:
      return Ktx2Primaries::kCieXyz;
  }
  throw std::logic_error("unknown primaries");
}

// [face][row][column][R, G, B, 1].
std::vector<float> texels_of(const SkyMap& map, const std::vector<float>& rgb) {
  const int side = map.width / map.faces;
  std::vector<float> texels;
  texels.reserve(rgb.size() / 3 * 4);
  for (int f = 0; f < map.faces; ++f) {
    const CubeMapFace face = map.faces > 1 ? kCubeMapFaces.at(static_cast<std::size_t>(f))
                                           : CubeMapFace{0, false, false};
    for (int y = 0; y < map.height; ++y) {
      const int row = face.upside_down ? map.height - 1 - y : y;
      for (int x = 0; x < side; ++x) {
        const int column = face.of_map * side + (face.right_to_left ? side - 1 - x : x);
        const float* const pixel = &rgb[3 * (static_cast<std::size_t>(row) * map.width + column)];
        texels.insert(texels.end(), {pixel[0], pixel[1], pixel[2], 1.0f});
      }
    }
  }
  return texels;
}

}  // namespace

void write_map_texture(const SkyMap& map, const std::vector<float>& rgb, Primaries primaries,
                       const std::filesystem::path& file) {
  const std::vector<float> texels = texels_of(map, rgb);
  Ktx2Texture texture{.width = static_cast<std::uint32_t>(map.width / map.faces),
                      .height = static_cast<std::uint32_t>(map.height),
                      .faces = static_cast<std::uint32_t>(map.faces),
                      .primaries = ktx2_primaries(primaries),
                      .metadata = map.metadata,
                      .texels = std::as_bytes(std::span(texels))};
  texture.metadata.emplace_back("KTXwriter", fmt::format("skyfit {}", kVersion));
  write_ktx2_file(file, texture);
}

}  // namespace skyfit
