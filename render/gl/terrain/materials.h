// SPDX-License-Identifier: Apache-2.0
// The textures of render/shaders/materials.glsl: solid (three-dimensional) noise, so that no
// surface has a seam. They repeat after one unit in each direction.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "model/base/content_cache.h"
#include "render/gl/context/objects.h"
#include "render/gl/context/uniform_block.h"

namespace skyfit {

inline constexpr int kMaterialSide = 64;  // texels

// RGBA8, x fastest: gradient of a relief, / 127 - 1 in each component; brightness, / 127.5, mean 1.
using MaterialTexels = std::vector<std::uint8_t>;

enum class Texture { kGrains, kCrags };  // soft and grainy; with ridges and cracks

MaterialTexels make_texture(Texture texture);

// From DIRECTORY/grains.png and crags.png, slices one below the other; made and saved when it is
// missing. Without a directory: from the cache, which may be null, or made. Throws
// std::runtime_error that names a file that cannot be read or written or has another size.
MaterialTexels load_texture(Texture texture, const std::filesystem::path& directory,
                            ContentCache* cache = nullptr);

// Those files, made where they are missing. Throws as above.
std::vector<std::filesystem::path> made_texture_files(const std::filesystem::path& directory);

// The texture and its mipmaps down to one texel: weighted means of 4 x 4 x 4 texels, each rounded
// once. Drivers round those of bytes in their own way and level by level, which tilts the distant
// ground. The last but one, whose texels hold next to nothing of the noise, is the mean of all as
// well.
std::vector<MaterialTexels> mipmaps_of(const MaterialTexels& texels);

class Materials {
 public:
  Materials(const std::filesystem::path& directory, ContentCache* cache);

  // Beyond it a pixel of that angle sees nothing but the grains' mean.
  static double grainless_distance_m(double pixel_rad);

  // As two textures from `unit` on, and what the shader needs. `camera`: planet coordinates, m.
  void bind(const glm::dvec3& camera, GLuint program, GLuint unit, UniformBuffers& buffers) const;

 private:
  GlTexture grains_, crags_;
  glm::vec4 grain_mean_, crag_mean_;
};

}  // namespace skyfit
