// SPDX-License-Identifier: Apache-2.0
// The ground into the G-buffer. Its materials come later, once a pixel: materials.glsl. Where it goes over into water is
// decided here, by the pixel: vertices are farther apart than that.
#include "render/shaders/gbuffer_write.glsl"

uniform vec4 water_reflectance;
uniform float own_reflectance_of_water;  // 1; 0: the ground's

in vec4 ground_normal;
in vec4 ground_reflectance;
in float ground_above_water;

void main() {
  float water = ground_above_water <= 0.0 ? 1.0 : 0.0;
  write_gbuffer(ground_normal.xyz, mix(ground_normal.w, WATER, water),
                mix(ground_reflectance, water_reflectance, own_reflectance_of_water * water));
}
