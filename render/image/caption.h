// SPDX-License-Identifier: Apache-2.0
// Captions below the frames of a grid, in bands of their own: white on black, each centred below
// its frame, all of one size.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/render.h"

namespace skyfit {

struct CaptionBands {
  int height = 0;
  std::vector<std::vector<std::uint8_t>> rgb;  // of each frame [pixel][3], as wide as the frame
};

// What a frame shows stands on one line, or with a line for each quantity, or with its name above
// its value: the first that fits, with text as large as a sixteenth of the frame's height, or as
// fits. Height 0 where no text of 8 pixels fits. Throws std::runtime_error where there is no font.
CaptionBands caption_bands(std::span<const std::vector<Caption>> captions, int frame_width,
                           int frame_height);

}  // namespace skyfit
