// SPDX-License-Identifier: Apache-2.0
// The G-buffer of Sperlhofer 2011, 4.4: colour at the four wavelengths, scaled to a largest component of 1, and in a second
// target the normal in the camera frame with that largest reflectance / pi. Deviation: the normal takes two components
// (an octahedron, Meyer et al. 2010), the third is the share of the second material, -1 where there is none of either.
const float kInversePi = 0.318309886183790672;

vec2 signs_of(vec2 v) { return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0); }

vec2 octahedral(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * signs_of(p);
}

vec3 from_octahedral(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * signs_of(n.xy);
  return normalize(n);
}
