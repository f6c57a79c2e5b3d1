// SPDX-License-Identifier: Apache-2.0
// Sorts the pixels by what the atmosphere's pass has to do for them.
uniform float grainless_depth;  // beyond it a pixel sees nothing but the grains' mean

// Of a pixel of that depth.
float class_of(float seen) {
  return seen == 0.0 ? SKY_CLASS : seen < grainless_depth ? GRAINLESS_CLASS : GRAINY_CLASS;
}
