// SPDX-License-Identifier: Apache-2.0
// Sorts the pixels by what the atmosphere's pass has to do for them; the classes are depths, which that pass tests against.
layout(binding = 0) uniform sampler2D depth;

uniform float grainless_depth;  // beyond it no grain of the ground is as large as a pixel

void main() {
  float seen = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).x;
  gl_FragDepth = seen == 0.0 ? SKY_CLASS : seen < grainless_depth ? GRAINLESS_CLASS : GRAINY_CLASS;
}
