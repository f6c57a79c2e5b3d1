// SPDX-License-Identifier: Apache-2.0
// From cd/m^2 to 8 bit sRGB.
#pragma once

#include <cstdint>
#include <vector>

#include "render/render.h"

namespace skyfit {

// [pixel][3], with an exposure that is set: the tone curve, the sRGB transfer function (IEC
// 61966-2-1), dithered with triangular noise of one step.
std::vector<std::uint8_t> tone_mapped(const Frame& frame, const ToneOptions& tone);

}  // namespace skyfit
