// SPDX-License-Identifier: Apache-2.0
// A vertex of a block and its place in the picture: between its own level's shape and the coarser one's, by its distance
// from the eye that it was chosen for, so that a level replaces another one without a step.
layout(location = 0) in vec3 fine_km;
layout(location = 1) in vec3 coarse_km;
layout(location = 6) in vec3 offset_km;
layout(location = 7) in vec2 morph_range_km;

uniform vec3 eye_km;  // from the camera, planet axes

// 0: the block's own shape, 1: the coarser one.
float morph() {
  float d = length(fine_km + offset_km - eye_km);
  return clamp((d - morph_range_km.x) / (morph_range_km.y - morph_range_km.x), 0.0, 1.0);
}
