// SPDX-License-Identifier: Apache-2.0
// One triangle over the whole picture, with what pixel_class.frag would else load anew for each pixel.
#include "render/shaders/whole_picture.glsl"

uniform vec2 tangent;  // of half the field of view
uniform float grainless_depth;

noperspective out vec2 slope;  // of a pixel's ray to the view's axis
flat out float grainless;

void main() {
  vec2 screen = corner_beyond_picture();
  slope = screen * tangent;
  grainless = grainless_depth;
  gl_Position = vec4(screen, 0.0, 1.0);
}
