// SPDX-License-Identifier: Apache-2.0
// Maps of all directions as textures.
#pragma once

#include <filesystem>
#include <vector>

#include "render/color_space.h"
#include "render/sky_map/sky_map.h"

namespace skyfit {

// Khronos Texture 2.0, see write_sky_map(); `rgb` is the map's light in the primaries.
void write_map_texture(const SkyMap& map, const std::vector<float>& rgb, Primaries primaries,
                       const std::filesystem::path& file);

}  // namespace skyfit
