// SPDX-License-Identifier: Apache-2.0
// Light that a colour space cannot hold: a channel of it would be negative.
#pragma once

#include <array>

#include "render/color_space.h"

namespace skyfit {

using ColorChannels = std::array<double, 3>;

// By the inverse of from_xyz; its second row.
double luminance_of(const ColorChannels& color, const ColorSpace& space);

ColorChannels converted(const ColorChannels& color, const ColorSpace& from, const ColorSpace& to);

// The light along the line to `white`, which has luminance 1, until no channel is negative: of the
// same luminance and hue, less saturated. Light that the space holds stays as it is; what has no
// luminance becomes 0.
ColorChannels into_gamut(const ColorChannels& color, double luminance, const ColorChannels& white);

}  // namespace skyfit
