// SPDX-License-Identifier: Apache-2.0
// Fills the picture of sky_view.glsl from the atmosphere's tables.
#define SKY_VIEW_WRITE
#include "render/shaders/sky_view.glsl"

layout(location = 0) out vec4 air;
layout(location = 1) out vec4 aerosol;
layout(location = 2) out vec4 depth;

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
