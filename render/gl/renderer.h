// SPDX-License-Identifier: Apache-2.0
// Draws a frame: the terrain into the G-buffer, the atmosphere over it, and the samples of a pixel
// into one.
#pragma once

#include <functional>

#include "render/render.h"

namespace skyfit {

// As render_frame() of render.h, without the preset's metadata.
Frame draw_frame(const AtmosphereTables& tables, const FrameOptions& options,
                 const std::function<void(double)>& progress);

}  // namespace skyfit
