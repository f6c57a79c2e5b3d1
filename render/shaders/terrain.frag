// SPDX-License-Identifier: Apache-2.0
// The ground into the G-buffer. Its materials come later, once a pixel: materials.glsl.
#include "render/shaders/gbuffer_write.glsl"

in vec4 ground_normal;
in vec4 ground_reflectance;

void main() { write_gbuffer(ground_normal.xyz, ground_normal.w, ground_reflectance); }
