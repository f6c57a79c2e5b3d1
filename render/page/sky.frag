// SPDX-License-Identifier: Apache-2.0
// What a pixel of the page sees, see seen_planet.glsl.
#include "render/shaders/seen_planet.glsl"
#include "render/shaders/view_ray.glsl"

in vec2 screen;
layout(location = 0) out vec4 light;
layout(location = 1) out vec4 disc;

void main() {
  SeenLight seen = seen_planet(normalize(ray_through(screen)), camera_km, suns[0].xyz);
  light = seen.light;
  disc = seen.disc;
}
