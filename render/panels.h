// SPDX-License-Identifier: Apache-2.0
// The parts of a frame as pictures for a screen.
#pragma once

#include <span>
#include <string_view>

#include "render/render.h"

namespace skyfit {

struct PanelEntry {
  std::string_view name;     // goes into the file's name
  std::string_view meaning;  // one line
  Frame (*draw)(const Frame& frame);
  bool is_light;  // shown with the frame's tone; otherwise linear, 1 is white
};
// In-scatter, reflected light with its two parts, transmittance, albedo, normal, depth.
std::span<const PanelEntry> frame_panels();

// PNG, 8 bit sRGB. Light has the exposure and the tone of the frame, so that in-scatter and
// reflected light can be compared with it. Throws std::logic_error for a frame without layers,
// std::runtime_error that names the file.
void write_panel(const PanelEntry& panel, const Frame& frame, const std::filesystem::path& file,
                 const ToneOptions& tone);

}  // namespace skyfit
