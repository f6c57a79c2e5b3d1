// SPDX-License-Identifier: Apache-2.0
// The G-buffer of Sperlhofer 2011, 4.4: colour at the four wavelengths, scaled to a largest component of 1, in eight bits
// each; normal in the planet's axes and that largest reflectance / pi; depth. Deviations: the normal takes two components
// (an octahedron, Meyer et al. 2010), the third is the share of the second material, below 0 where there is none of either; all
// are packed into one target of four words, which a renderer in software reads sooner than a target each.
#include "render/shaders/pi.glsl"

// In the place of a material's share: of things that are no ground, and of water, below the limit.
#define NO_MATERIAL -0.5
#define WATER -1.0
#define WATER_LIMIT -0.75

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

struct GroundSample {
  vec3 normal;
  float rock;
  vec4 reflectance;
  float depth;  // near / distance along the view's axis
};

uvec4 pack_ground(GroundSample at) {
  vec4 c = at.reflectance;
  float largest = max(max(c.x, c.y), max(c.z, max(c.w, 1e-6)));
  return uvec4(packUnorm4x8(c / largest), packSnorm2x16(octahedral(at.normal)),
               packSnorm2x16(vec2(at.rock, largest * kInversePi)), floatBitsToUint(at.depth));
}

// As GLSL's own, without its divisions.
vec2 unpack_two(uint word) { return vec2(ivec2(int(word) << 16, int(word)) >> 16) * (1.0 / 32767.0); }
vec4 unpack_four(uint word) { return vec4(uvec4(word, word >> 8, word >> 16, word >> 24) & 255u) * (1.0 / 255.0); }

GroundSample unpack_ground(uvec4 words) {
  vec2 rock_and_largest = unpack_two(words.z);
  return GroundSample(from_octahedral(unpack_two(words.y)), rock_and_largest.x,
                      unpack_four(words.x) * (kPi * rock_and_largest.y), uintBitsToFloat(words.w));
}
