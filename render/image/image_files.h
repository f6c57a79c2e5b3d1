// SPDX-License-Identifier: Apache-2.0
// Frames as OpenEXR and PNG files; see render.h.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "model/tables/table_precision.h"
#include "render/render.h"
#include "render/sky_map/sky_map.h"

namespace skyfit {

void write_exr_file(const Frame& frame, const std::filesystem::path& file);
// .npy of (height x width x channels), .ktx2 of XYZ without layers, else a picture.
void write_map_file(const SkyMap& map, Primaries primaries, const std::filesystem::path& file);
// R, G, B and A of a table of float or half, see render/engine/table_files.h.
void write_table_file(const EncodedTable& table, const std::filesystem::path& file);
void write_png_file(const Frame& frame, const std::filesystem::path& file, const ToneOptions& tone);
void write_grid_file(const FrameGrid& grid, const std::filesystem::path& file);

// RGBA, 8 bit, as they are.
void write_png_texels(std::span<const std::uint8_t> rgba, int width, int height,
                      const std::filesystem::path& file);

}  // namespace skyfit
