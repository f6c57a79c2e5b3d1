// SPDX-License-Identifier: Apache-2.0
// Colours as lightness, and two axes of colour about grey in which hues are straight lines: Oklab,
// Ottosson 2020, https://bottosson.github.io/posts/oklab/. Homogeneous: k^3 times the light gives k
// times all three, so that hue and chroma / lightness do not depend on the exposure.
#pragma once

#include "render/image/gamut.h"

namespace skyfit {

struct Oklab {
  double l, a, b;  // l = 1 for the white of luminance 1
};

Oklab oklab_of(const ColorChannels& color, const ColorSpace& space);
ColorChannels from_oklab(const Oklab& lab, const ColorSpace& space);

}  // namespace skyfit
