// SPDX-License-Identifier: Apache-2.0
// One triangle over the whole picture; screen runs from -1 to 1.
#include "render/shaders/whole_picture.glsl"

out vec2 screen;

void main() {
  screen = corner_beyond_picture();
  gl_Position = vec4(screen, 0.0, 1.0);
}
