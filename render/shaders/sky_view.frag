// SPDX-License-Identifier: Apache-2.0
// Fills the picture of sky_view.glsl from the atmosphere's tables.
#define SKY_VIEW_WRITE
#include "render/shaders/sky_view.glsl"

layout(location = 0) out vec4 air;
layout(location = 1) out vec4 aerosol;
layout(location = 2) out vec4 depth;

#ifdef HILLAIRE
void main() {
  vec2 texel = gl_FragCoord.xy - 0.5;
  int i = int(texel.x / sky_view_size.x);
  vec3 sun = suns[i].xyz;
  float h = min(camera_km, thickness_km);
  vec2 direction = hillaire_direction_in_view(texel - vec2(float(i) * sky_view_size.x, 0.0), h);
  float sines = sqrt(max((1.0 - direction.x * direction.x) * (1.0 - sun.z * sun.z), 0.0));
  float nu = clamp(direction.x * sun.z + sines * direction.y, -1.0, 1.0);
  air = radiance(hillaire_ray(Place(h, direction.x, sun.z), nu), nu);
  aerosol = depth = vec4(0.0);
}
#else
void main() {
  vec2 texel = gl_FragCoord.xy - 0.5;
  int picture = int(texel.x / sky_view_size.x);  // of a sun and a class, see sky_view.glsl
  int i = picture % kSuns;
  vec3 sun = suns[i].xyz;
  ViewRay ray = ray_in_view(texel - vec2(float(picture) * sky_view_size.x, 0.0), sun, sky_view_size);
  float nu = clamp(dot(ray.direction, sun), -1.0, 1.0);
  Scattering all = scattering(place_of(ray, sun, nu), nu, ray.hits_ground);
  air = log(max(all.rayleigh_like, 1e-30));
  aerosol = log(max(all.single[picture / kSuns], 1e-30));
  depth = optical_depth_past_ground(ray.h, ray.hits_ground ? 1.0 : ray.mu);
}
#endif
