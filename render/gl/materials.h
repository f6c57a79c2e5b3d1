// SPDX-License-Identifier: Apache-2.0
// Textures of the ground's two materials: solid (three-dimensional) noise, so that no surface has a
// seam. They repeat after one unit in each direction.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "render/gl/objects.h"

namespace skyfit {

inline constexpr int kMaterialSide = 64;  // texels

// RGBA8, x fastest: gradient of a relief, / 127 - 1 in each component; brightness, / 127.5, mean 1.
using MaterialTexels = std::vector<std::uint8_t>;

enum class Material { kSoil, kRock };

MaterialTexels make_material(Material material);

// From DIRECTORY/soil.png and rock.png, slices one below the other; made and saved when it is
// missing, only made when `directory` is empty. Throws std::runtime_error that names a file that
// cannot be read or written or has another size.
MaterialTexels load_material(Material material, const std::filesystem::path& directory);

// With mipmaps.
GlTexture material_texture(const MaterialTexels& texels);

}  // namespace skyfit
