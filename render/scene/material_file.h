// SPDX-License-Identifier: Apache-2.0
// A user's own materials of the ground, as materials.json in a folder of textures names them:
//   {"skyfit_materials": 1,
//    "soil": {"color": "grass.png", "normal": "grass-normal.png", "near_m": 3, "far_m": 80},
//    "rock": {"color": "granite.jpg"}}
// What it leaves out is the program's own.
#pragma once

#include <filesystem>
#include <string_view>

#include "model/base/input_file.h"
#include "render/render.h"

namespace skyfit {

inline constexpr std::string_view kMaterialFile = "materials.json";

struct OwnMaterials {
  OwnMaterial soil, rock;
};

// None of a folder that has no such file. With a map of the ground's colours, a material may have
// no colour. Throws std::invalid_argument or std::runtime_error in one line that names the file,
// the line and the field; the pictures themselves are read with the ground.
OwnMaterials read_materials(const std::filesystem::path& folder, NamedFiles allowed,
                            const std::filesystem::path& color_map = {});

}  // namespace skyfit
