// SPDX-License-Identifier: Apache-2.0
// The ground's depth alone.
#include "render/shaders/terrain_block.glsl"

uniform mat4 clip_from_planet;

void main() {
  gl_Position = clip_from_planet * vec4(mix(fine_km, coarse_km, morph()) + offset_km, 1.0);
}
