// SPDX-License-Identifier: Apache-2.0
// From the targets of a frame, samples_per_side^2 samples to a pixel, to the pixels of a Frame:
// light and layers are the means of the samples, the distance is that of the nearest. The frame has
// its size before.
#pragma once

#include "render/gl/passes/passes.h"
#include "render/render.h"

namespace skyfit {

// rgb and luminance (cd/m^2) and depth_m.
void resolve_light(const FrameGraph& graph, int samples_per_side, Frame& frame);

// After resolve_light().
FrameLayers resolve_layers(const FrameGraph& graph, int samples_per_side, const Frame& frame);

// view_zenith_deg, view_azimuth_deg and, after resolve_light(), solid angles of discs' pixels.
void add_directions(const Camera& camera, Frame& frame);

}  // namespace skyfit
