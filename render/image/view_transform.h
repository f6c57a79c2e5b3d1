// SPDX-License-Identifier: Apache-2.0
// render/shaders/view_transform.glsl in C++: see there.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace skyfit::view_transform {

using Number = double;
using vec3 = glm::dvec3;
using mat3 = glm::dmat3;

Number film_curve(Number x);
Number srgb_transfer(Number x);
vec3 oklab_from(vec3 color, mat3 xyz_from);
vec3 color_from_oklab(vec3 lab, mat3 from_xyz);
vec3 gamut_mapped(vec3 color, Number luminance, mat3 from_xyz, mat3 xyz_from);
vec3 display_mapped(vec3 color, mat3 from_xyz, mat3 xyz_from);
vec3 displayed(vec3 color, Number luminance, Number curved_luminance, mat3 from_xyz, mat3 xyz_from);

}  // namespace skyfit::view_transform
