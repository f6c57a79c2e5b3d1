// SPDX-License-Identifier: Apache-2.0
// The three things that `skyfit render` draws.
#pragma once

#include "cli/render_request.h"

namespace skyfit::cli {

void render_picture(const RenderRequest& request);

// Frames side by side in which one parameter varies.
void render_strip(const RenderRequest& request);

// Numbered frames and a video; what is there already is kept.
void render_sequence(const RenderRequest& request);

}  // namespace skyfit::cli
