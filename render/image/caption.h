// SPDX-License-Identifier: Apache-2.0
// Captions below the parts of a picture, in a band of their own: white on black, each centred below
// its part, all of one size.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/render.h"

namespace skyfit {

struct CaptionBand {
  int height = 0;
  std::vector<std::uint8_t> rgb;  // [pixel][3]; height rows that are as wide as the picture
};

// The captions stand on one line or, where that is too long, name above value, as large as a
// sixteenth of the picture's height, or as fits. Empty where no text of 8 pixels fits. Throws
// std::runtime_error where there is no font.
CaptionBand caption_band(std::span<const Caption> captions, int width, int height);

}  // namespace skyfit
