// SPDX-License-Identifier: Apache-2.0
// Where refraction by air shows a sun's disc, and how it bends the rays to it: docs/theory (14).
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "model/atmosphere/refraction.h"

namespace skyfit {

// First x: the zenith angle z_0 at which the centre of a disc is seen that stands at `true_zenith`
// and has `radius`, by an eye at a height above the ground; y, z, w: the bending of a ray of zenith
// angle z is exp(y + z d + w d^2), d = z - z_0, exact at the disc's centre and on its upper and
// lower limb. Then x, y: what d stays within, half again as far as the limbs are seen. Metres and
// radians.
std::array<glm::vec4, 2> disc_bending(const Refraction& refraction, double height_m,
                                      double true_zenith, double radius);

}  // namespace skyfit
