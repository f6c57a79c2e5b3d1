// SPDX-License-Identifier: Apache-2.0
#include "render/shaders/gbuffer.glsl"

layout(location = 0) out vec4 color;
layout(location = 1) out vec4 surface;

void write_gbuffer(vec3 normal, float material, vec4 reflectance) {
  float largest = max(max(reflectance.x, reflectance.y), max(reflectance.z, max(reflectance.w, 1e-6)));
  color = reflectance / largest;
  surface = vec4(octahedral(normal), material, largest * kInversePi);
}
