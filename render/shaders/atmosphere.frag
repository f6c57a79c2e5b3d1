// SPDX-License-Identifier: Apache-2.0
// The atmosphere as one pass over the G-buffer, as fragments.
#define FLAT_CONSTANTS
#include "render/shaders/pixel_light.glsl"

noperspective in vec3 site_ray, planet_ray;  // pixel_ray.glsl
layout(location = 0) out vec4 light;
layout(location = 1) out float distance_km;
#ifdef LAYERS
layout(location = 2) out vec4 in_scatter_layer;
layout(location = 3) out vec4 reflected_layer;
layout(location = 4) out vec4 transmittance_layer;
layout(location = 5) out vec4 albedo_layer;
layout(location = 6) out vec4 normal_layer;
#endif
#ifdef DISC
layout(location = DISC_LOCATION) out vec4 disc_light;
#endif

void main() {
  Seen seen = seen_at(ivec2(gl_FragCoord.xy), site_ray, planet_ray);
  light = seen.light;
  distance_km = seen.distance_km;
#ifdef DISC
  disc_light = seen.disc;
#endif
#ifdef LAYERS
  in_scatter_layer = seen.in_scatter;
  reflected_layer = seen.reflected;
  transmittance_layer = seen.transmittance;
  albedo_layer = seen.albedo;
  normal_layer = seen.normal;
#endif
}
