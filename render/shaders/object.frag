// SPDX-License-Identifier: Apache-2.0
// A thing beside the ground into the G-buffer; a face seen from behind turns its normal to the eye.
#include "render/shaders/gbuffer_write.glsl"

in vec3 planet_normal;
in vec4 object_reflectance;

void main() { write_gbuffer(gl_FrontFacing ? planet_normal : -planet_normal, NO_MATERIAL, object_reflectance); }
