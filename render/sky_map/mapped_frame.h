// SPDX-License-Identifier: Apache-2.0
// A frame of all directions: the faces of a cube about the camera are drawn in perspective, with a
// sample in each pixel, and laid out by one of map_projections().
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "model/geometry/map_projection.h"
#include "render/render.h"

namespace skyfit {

// Of another projection than perspective.
const MapProjectionEntry& entry_of(PictureProjection projection);

// Whether the camera's view_zenith is that of the picture.
bool has_direction(PictureProjection projection);

// That of the options' size and field of view; null: perspective. Throws std::invalid_argument
// `render.name = value: must be ...` for a size or a field of view that the projection has not.
std::unique_ptr<MapProjection> projection_of(const FrameOptions& options);

// The frames in perspective that a picture is made of: those faces of which it shows something.
std::vector<FrameOptions> cube_faces(const FrameOptions& options);

// Draws one of them.
using DrawFace =
    std::function<Frame(const FrameOptions& face, const std::function<void(double)>& progress)>;

// A pixel is the mean of samples_per_side^2 samples, each of the sky interpolated on a face, of all
// else the nearest there; samples of a face are in its middle as wide as the picture's widest:
// narrower on a face of less than 256 x 256, wider on one of more than 2^25. A sun's disc keeps the
// illuminance that it has on the faces. Without glare and metadata. Progress in 0..1; may be empty.
// Throws what `draw` throws.
Frame mapped_frame(const FrameOptions& options, const DrawFace& draw,
                   const std::function<void(double)>& progress);

}  // namespace skyfit
