// SPDX-License-Identifier: Apache-2.0
// One triangle over the whole picture.
#include "render/shaders/pixel_ray.glsl"

void main() {
  vec2 screen = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  pass_ray(screen);
  pass_constants();
  gl_Position = vec4(screen, 0.0, 1.0);
}
