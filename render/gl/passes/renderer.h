// SPDX-License-Identifier: Apache-2.0
// Draws frames: the planet and what stands on it into the G-buffer, the atmosphere over it, and the
// samples of a pixel into one.
#pragma once

#include <memory>

#include "render/module/module.h"

namespace skyfit {

// What the Renderer of render.h draws with.
std::unique_ptr<FrameDrawer> make_drawer(const Scene& scene, GraphicsDevice device,
                                         std::shared_ptr<ContentCache> cache);

}  // namespace skyfit
