// SPDX-License-Identifier: Apache-2.0
// Light of the suns' discs that scatters in an eye: the CIE's total glare function, CIE 146:2002;
// Vos & van den Berg 1999, eq. 8, for an age of 35 years and a pigmentation of 0.5. Deviations: its
// two innermost terms, the eye's blur, are their tails that begin at 0.3 degrees, for the disc
// stays sharp; a sun outside of the picture and what is not a sun have no glare.
#pragma once

#include <vector>

#include "render/render.h"

namespace skyfit {

// 1/sr: luminance of the veil over the source's illuminance at the eye, at an angle from it.
double glare_function(double angle_deg);

// [pixel][3], cd/m^2 in the frame's primaries; empty for a frame without a disc.
std::vector<float> glare_of(const Frame& frame);

}  // namespace skyfit
