// SPDX-License-Identifier: Apache-2.0
// Frames as OpenEXR and PNG files; see render.h.
#pragma once

#include <filesystem>

#include "render/render.h"

namespace skyfit {

void write_exr_file(const Frame& frame, const std::filesystem::path& file);
void write_png_file(const Frame& frame, const std::filesystem::path& file, const ToneOptions& tone);

}  // namespace skyfit
