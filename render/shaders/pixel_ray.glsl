// SPDX-License-Identifier: Apache-2.0
// The ray through a pixel, for the fragments of a pass over the picture.
#include "render/shaders/view_ray.glsl"

noperspective out vec3 site_ray;    // camera frame
noperspective out vec3 planet_ray;  // planet's axes

void pass_ray(vec2 screen) {
  site_ray = ray_through(screen);
  planet_ray = planet_from_site * site_ray;
}
