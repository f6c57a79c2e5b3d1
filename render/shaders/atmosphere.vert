// SPDX-License-Identifier: Apache-2.0
// One triangle over the whole picture.
#include "render/shaders/pixel_ray.glsl"
#include "render/shaders/whole_picture.glsl"

void main() {
  vec2 screen = corner_beyond_picture();
  pass_ray(screen);
  pass_constants();
  gl_Position = vec4(screen, 0.0, 1.0);
}
