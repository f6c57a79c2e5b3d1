// SPDX-License-Identifier: Apache-2.0
// Sorts the pixels by what the atmosphere's pass has to do for them.
uniform float grainless_depth;  // near / distance beyond which a pixel sees nothing but the grains' mean

// Of a pixel of that depth whose ray is so long for each unit along the view's axis.
float class_of(float seen, float stretch) {
  return seen == 0.0 ? SKY_CLASS : seen < grainless_depth * stretch ? GRAINLESS_CLASS : GRAINY_CLASS;
}
