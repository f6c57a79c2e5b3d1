// SPDX-License-Identifier: Apache-2.0
// Linear light of sRGB's primaries (model/photometry/photometry.h), in the unit of the Y of XYZ.
#pragma once

#include "fit/exchange/reduction.h"

namespace skyfit::fit {

Rgb linear_srgb(const Xyz& xyz);  // negative where the primaries do not hold the colour
std::vector<Rgb> linear_srgb(const std::vector<Xyz>& colors);
Xyz xyz_of_srgb(const Rgb& rgb);

}  // namespace skyfit::fit
