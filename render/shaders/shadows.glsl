// SPDX-License-Identifier: Apache-2.0
// Shadows that the terrain casts under each sun: maps of the depth seen from the sun, each of a larger part of the terrain
// about the camera.
#include "render/shaders/view_ray.glsl"

layout(binding = 12) uniform sampler2DArrayShadow shadow_maps;

const int kShadowMaps = 3;
layout(std140, binding = 3) uniform Shadows {
  mat4 map_from_site[kSuns * kShadowMaps];  // of positions relative to the camera; x, y, depth in 0..1; sun after sun
  vec4 shadow_offset_km;                    // off a surface that must not shade itself, of each of a sun's maps
  float shadow_map_count;                   // of a sun, that hold, from the finest on
  float shadow_reach_km;                    // half a side of the largest of them
};

// The number of a sun's map among all that hold.
int map_of(int sun, int i) { return sun * int(shadow_map_count) + i; }

// x, y, map of those of a sun, depth of the finest that holds the position; a map of -1 where none does.
vec4 place_in_maps(vec3 position, int sun) {
  vec4 found = vec4(0.0, 0.0, -1.0, 0.0);
  for (int i = kShadowMaps - 1; i >= 0; --i) {
    vec3 p = (map_from_site[map_of(sun, i)] * vec4(position, 1.0)).xyz;
    vec2 from_middle = abs(p.xy - 0.5);
    // Beyond its end, a map says that everything is shaded; what lies before its beginning is held there.
    bool inside = max(from_middle.x, from_middle.y) < 0.49 && p.z < 1.0;
    if (inside && float(i) < shadow_map_count) found = vec4(p.xy, float(i), p.z);
  }
  return found;
}

// The place in the maps for a position on or above a surface that faces `normal`, off it by the offset of the map.
vec4 place_off(vec3 position, vec3 normal, int sun) {
  float map = place_in_maps(position, sun).z;
  return place_in_maps(position + shadow_offset_km[int(max(map, 0.0))] * normal, sun);
}

// Share of the sun that the map lets through there.
float lit_in_map(vec4 place, int sun) {
  return texture(shadow_maps, vec4(place.xy, float(map_of(sun, int(place.z))), place.w));
}

// Of the shadow that the largest map holds at a position: it fades toward the map's border, beyond which there is none.
float shadow_strength(vec3 position, int sun) {
  vec2 from_middle = abs((map_from_site[map_of(sun, int(shadow_map_count) - 1)] * vec4(position, 1.0)).xy - 0.5);
  return 1.0 - smoothstep(0.36, 0.48, max(from_middle.x, from_middle.y));
}

// Share of a sun that reaches a surface.
float sunlit(vec3 position, vec3 normal, int sun) {
  vec4 place = place_off(position, normal, sun);
  if (place.z < 0.0) return 1.0;
  vec2 texel = 0.75 / vec2(textureSize(shadow_maps, 0).xy);
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 corner = vec2((i & 1) == 0 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0);
    sum += lit_in_map(vec4(place.xy + corner * texel, place.zw), sun);
  }
  return mix(1.0, 0.25 * sum, shadow_strength(position, sun));
}
