// SPDX-License-Identifier: Apache-2.0
// Shadows that the terrain casts under the first sun, on surfaces and in the air: maps of the depth seen from the sun,
// each of a larger part of the terrain about the camera.
#include "render/shaders/densities.glsl"
#include "render/shaders/view_ray.glsl"

layout(binding = 12) uniform sampler2DArrayShadow shadow_maps;

const int kShadowMaps = 3;
layout(std140, binding = 3) uniform Shadows {
  mat4 map_from_site[kShadowMaps];  // of positions relative to the camera; x, y, depth in 0..1
  vec4 shadow_offset_km;            // off a surface that must not shade itself, of each map
  float shadow_map_count;           // that hold, from the finest on
  float shadow_reach_km;            // half a side of the largest of them
};

// x, y, map, depth of the finest map that holds the position; a map of -1 where none does.
vec4 place_in_maps(vec3 position) {
  vec4 found = vec4(0.0, 0.0, -1.0, 0.0);
  for (int i = kShadowMaps - 1; i >= 0; --i) {
    vec3 p = (map_from_site[i] * vec4(position, 1.0)).xyz;
    vec2 from_middle = abs(p.xy - 0.5);
    // Beyond its end, a map says that everything is shaded; what lies before its beginning is held there.
    bool inside = max(from_middle.x, from_middle.y) < 0.49 && p.z < 1.0;
    if (inside && float(i) < shadow_map_count) found = vec4(p.xy, float(i), p.z);
  }
  return found;
}

// The place in the maps for a position on or above a surface that faces `normal`, off it by the offset of the map.
vec4 place_off(vec3 position, vec3 normal) {
  float map = place_in_maps(position).z;
  return place_in_maps(position + shadow_offset_km[int(max(map, 0.0))] * normal);
}

// Of the shadow that the largest map holds at a position: it fades toward the map's border, beyond which there is none.
float shadow_strength(vec3 position) {
  vec2 from_middle = abs((map_from_site[int(shadow_map_count) - 1] * vec4(position, 1.0)).xy - 0.5);
  return 1.0 - smoothstep(0.36, 0.48, max(from_middle.x, from_middle.y));
}

// Share of the sun that reaches a surface.
float sunlit(vec3 position, vec3 normal) {
  vec4 place = place_off(position, normal);
  if (place.z < 0.0) return 1.0;
  vec2 texel = 0.75 / vec2(textureSize(shadow_maps, 0).xy);
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) {
    vec2 corner = vec2((i & 1) == 0 ? -1.0 : 1.0, i < 2 ? -1.0 : 1.0);
    sum += texture(shadow_maps, vec4(place.xy + corner * texel, place.zw));
  }
  return mix(1.0, 0.25 * sum, shadow_strength(position));
}

// What the sun's beam would scatter into a view ray from the parts that are in shadow, which the tables hold as lit.
// Steps along the ray, begun at another place in each pixel.
vec4 shaded_light(ViewRay ray, Place start, float nu, float length_km) {
  const int kSteps = 24;
  float reach = min(length_km, shadow_reach_km - ray.entry);
  if (reach <= 0.0) return vec4(0.0);
  float step_km = reach / float(kSteps);
  // Jimenez 2014: interleaved gradient noise.
  float begin = fract(52.9829189 * fract(dot(pixel_centre, vec2(0.06711056, 0.00583715))));
  vec4 sum = vec4(0.0);
  for (int i = 0; i < kSteps; ++i) {
    float t = (float(i) + begin) * step_km;
    vec3 position = (ray.entry + t) * ray.direction;
    // The air above level ground is not in its shadow.
    vec4 place = place_off(position, normalize(position + vec3(0.0, 0.0, bottom_km + camera_km)));
    float lit = place.z < 0.0 ? 1.0 : texture(shadow_maps, place);
    Place at = place_along(start, nu, t);
    vec4 light = transmittance_between(start, at, ray.hits_ground) * sun_transmittance(at.h, at.mu_s);
    sum += shadow_strength(position) * (1.0 - lit) * light * radiance(scattering_at(at.h), nu);
  }
  return sum * step_km;
}
