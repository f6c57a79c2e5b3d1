// SPDX-License-Identifier: Apache-2.0
// A strip: frames side by side in one picture.
#pragma once

#include <span>

#include "render/render.h"

namespace skyfit {

// From left to right with `gap` black pixels between them. All must have the same height, and
// layers all or none; the metadata is the first's, statistics are not kept.
Frame side_by_side(std::span<const Frame> frames, int gap);

}  // namespace skyfit
