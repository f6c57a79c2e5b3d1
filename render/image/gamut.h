// SPDX-License-Identifier: Apache-2.0
// Light that a colour space or a display cannot hold. What is changed keeps its hue, the angle in
// the plane a, b of Oklab (render/image/oklab.h): along a straight line to white in linear light,
// blue becomes purple and orange becomes yellow. render/shaders/view_transform.glsl has the
// formulas.
#pragma once

#include <array>

#include "render/color_space.h"

namespace skyfit {

using ColorChannels = std::array<double, 3>;

// By the inverse of from_xyz; its second row.
double luminance_of(const ColorChannels& color, const ColorSpace& space);

ColorChannels converted(const ColorChannels& color, const ColorSpace& from, const ColorSpace& to);

// Less chroma at the same luminance and hue, until no channel is negative. Light that the space
// holds stays as it is; what has no luminance becomes 0.
ColorChannels into_gamut(const ColorChannels& color, double luminance, const ColorSpace& space);

// Linear light of a display whose channels are 0..1, of the same hue as `color`, which must not be
// negative. What is brighter loses chroma, and little lightness: Ottosson 2021, "sRGB gamut
// clipping", towards a grey that depends on lightness and chroma.
ColorChannels into_display(const ColorChannels& color);

// The same of light whose luminance a tone curve has changed.
ColorChannels displayed(const ColorChannels& color, double luminance, double curved_luminance);

}  // namespace skyfit
