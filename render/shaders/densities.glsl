// SPDX-License-Identifier: Apache-2.0
// Densities of the atmosphere's constituents over height.
#include "render/shaders/atmosphere.glsl"

layout(binding = 13) uniform sampler2D densities;  // of the air, of the aerosol, relative to h = 0

vec2 densities_at(float h) {
  return texture(densities, vec2(height_coordinate(h, float(textureSize(densities, 0).x)), 0.5)).xy;
}
