// SPDX-License-Identifier: Apache-2.0
// The three things that `skyfit render` draws.
#pragma once

#include "cli/grid_request.h"
#include "cli/render_request.h"

namespace skyfit::cli {

void render_picture(const RenderRequest& request);

// Frames in rows and columns along which quantities vary, as one picture.
void render_grid(const GridRequest& request);

// Numbered frames and a video; what is there already is kept.
void render_sequence(const RenderRequest& request);

}  // namespace skyfit::cli
