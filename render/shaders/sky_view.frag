// SPDX-License-Identifier: Apache-2.0
// Fills the picture of sky_view.glsl from the atmosphere's tables.
#define SKY_VIEW_WRITE
#include "render/shaders/sky_view.glsl"

layout(location = 0) out vec4 air;
layout(location = 1) out vec4 aerosol;
layout(location = 2) out vec4 depth;

void main() {
  vec2 texel = gl_FragCoord.xy - 0.5;
  int i = texel.x < sky_view_size.x ? 0 : kSuns - 1;
  float turn = (texel.x - float(i) * sky_view_size.x) / (sky_view_size.x - 1.0) * kPi;
  bool hits_ground = texel.y < sky_view_size.y - 0.5;
  float h = min(camera_km, thickness_km);
  float v = (texel.y + 0.5) / (sky_view_size.y + sky_view_size.z);
  float mu = mu_from_texture(v, h, sky_view_size.y, sky_view_size.z, bottom_km, thickness_km);
  vec3 sun = suns[i].xyz;
  vec2 sunward = length(sun.xy) > 1e-9 ? normalize(sun.xy) : vec2(1.0, 0.0);
  // From outside the rays that enter point down; those of the table that leave are nobody's.
  ViewRay ray = ViewRay(vec3(0.0), true, hits_ground, 0.0, h, mu);
  float sine = sqrt(max(1.0 - mu * mu, 0.0)), z = mu;
  if (camera_km > thickness_km) {
    float r0 = bottom_km + camera_km, top = bottom_km + thickness_km;
    ray.mu = -abs(mu);
    sine *= top / r0;
    z = -sqrt(1.0 - sine * sine);
    ray.entry = -r0 * z + top * ray.mu;
  }
  vec2 across = cos(turn) * sunward + sin(turn) * vec2(-sunward.y, sunward.x);
  ray.direction = vec3(sine * across, z);
  float nu = clamp(dot(ray.direction, sun), -1.0, 1.0);
  Place start = place_of(ray, sun, nu);
  Scattering all = scattering(start, nu, hits_ground);
  air = log(max(all.rayleigh_like, 1e-30));
  aerosol = log(max(all.single_mie, 1e-30));
  depth = optical_depth_to_top(h, hits_ground ? 1.0 : ray.mu);
}
