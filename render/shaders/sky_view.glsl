// SPDX-License-Identifier: Apache-2.0
// The scattered light of whole rays from the eye, and their optical depth, as a picture over all directions: what every
// pixel would look up in the tables at the same height, made once a frame. Rows as in the scattering table, columns by the
// azimuth from the sun, each sun its own. A multiple of the table's texels, so that the two interpolate alike.
#include "render/shaders/view_ray.glsl"

#ifndef SKY_VIEW_WRITE
layout(binding = 8) uniform sampler2D view_air;      // logarithm of the amplitude
layout(binding = 9) uniform sampler2D view_aerosol;  // the same of single scattering by the aerosol
layout(binding = 10) uniform sampler2D view_depth;    // optical depth to the top; of rays to the ground: backward

vec2 place_in_view(ViewRay ray, vec3 sun, int i) {
  float across = length(ray.direction.xy) * length(sun.xy);
  float cosine = clamp(dot(ray.direction.xy, sun.xy) / max(across, 1e-9), -1.0, 1.0);
  float x = texture_from_unit(unit_from_azimuth(cosine), sky_view_size.x);
  return vec2((float(i) + x) / float(kSuns), texture_from_view(ray.h, ray.mu, ray.hits_ground, sky_view_size.y,
                                                               sky_view_size.z, bottom_km, thickness_km));
}

Scattering view_scattering(vec2 place) { return Scattering(exp(texture(view_air, place)), exp(texture(view_aerosol, place))); }
#endif
