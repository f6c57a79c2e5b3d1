// SPDX-License-Identifier: Apache-2.0
// Sorts the pixels by what the atmosphere's pass has to do for them.

// Of a pixel of that depth, which sees nothing but the grains' mean where near / distance is less than `grainless`; `ray`
// is of length 1 along the view's axis.
float class_of(float seen, float grainless, vec3 ray) {
  return seen == 0.0 ? SKY_CLASS : seen < grainless * length(ray) ? GRAINLESS_CLASS : GRAINY_CLASS;
}
