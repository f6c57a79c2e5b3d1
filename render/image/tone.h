// SPDX-License-Identifier: Apache-2.0
// From cd/m^2 to 8 bit sRGB.
#pragma once

#include <cstdint>
#include <vector>

#include "render/image/gamut.h"
#include "render/render.h"

namespace skyfit {

// Linear light of an sRGB display, 0..1, for light in linear sRGB, not negative, times the
// exposure: tone curve and view transform.
ColorChannels display_light(const ColorChannels& scene, const ToneOptions& tone);

// [pixel][3], with an exposure that is set: display_light() of the light with the frame's glare, of
// the parts of a pixel that a disc does and does not cover, and of sky and ground, each by itself;
// the sRGB transfer function (IEC 61966-2-1), dithered with triangular noise of one step.
std::vector<std::uint8_t> tone_mapped(const Frame& frame, const ToneOptions& tone);

}  // namespace skyfit
