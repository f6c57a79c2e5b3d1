// SPDX-License-Identifier: Apache-2.0
// Between a colour space and CIE 1931 XYZ.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "render/image/gamut.h"

namespace skyfit {

glm::dvec3 xyz_of(const ColorChannels& color, const ColorSpace& space);
ColorChannels from_xyz(const glm::dvec3& xyz, const ColorSpace& space);

}  // namespace skyfit
