// SPDX-License-Identifier: Apache-2.0
// The ray through a pixel, for the fragments of a pass over the picture: of length 1 along the view's axis, so that it is
// linear over the picture.
#include "render/shaders/view_ray.glsl"

noperspective out vec3 site_ray;    // camera frame
noperspective out vec3 planet_ray;  // planet's axes

// `screen` runs from -1 to 1.
void pass_ray(vec2 screen) {
  site_ray = site_from_view * vec3(screen * tangent, -1.0);
  planet_ray = planet_from_site * site_ray;
}
