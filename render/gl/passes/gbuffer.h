// SPDX-License-Identifier: Apache-2.0
// The G-buffer (Sperlhofer 2011, 4.4): what the planet and the things on it write, see
// render/shaders/gbuffer.glsl.
#pragma once

#include <string>
#include <vector>

#include "render/gl/passes/passes.h"

namespace skyfit {

inline const std::vector<std::string> kGBuffer = {"gbuffer", "depth"};

// Its targets, in samples.
void add_gbuffer(int width, int height, FrameGraph& graph);

// Clears the depth of the pass that runs and sets the test against reversed depth, near / distance:
// 0 where nothing is, where the other target holds anything.
void clear_gbuffer();

}  // namespace skyfit
