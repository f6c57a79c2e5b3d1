// SPDX-License-Identifier: Apache-2.0
// The scattered light of whole rays from the eye, and their optical depth, as a picture over all directions: what every
// pixel would look up in the tables at the same height, made once a frame. Rows as in the scattering table, columns by the
// azimuth from the sun, each sun its own. A multiple of the table's texels, so that the two interpolate alike. Not for an eye
// high above, FROM_ABOVE: there the sun's height at the far end of a ray changes too fast with the azimuth.
#include "render/shaders/view_ray.glsl"

#ifndef SKY_VIEW_WRITE
layout(binding = 8) uniform sampler2D view_air;      // logarithm of the amplitude
layout(binding = 9) uniform sampler2D view_aerosol;  // the same of single scattering by the aerosol
layout(binding = 10) uniform sampler2D view_depth;    // optical depth to the top, of rays that miss the ground

struct WholeRay {
  Scattering scattering;
  vec4 depth;
};

WholeRay whole_ray(ViewRay ray, Place start, vec3 sun, float nu, int i) {
#ifdef FROM_ABOVE
  return WholeRay(scattering(start, nu, ray.hits_ground),
                  optical_depth_to_top(ray.h, ray.mu));
#else
  float across = length(ray.direction.xy) * length(sun.xy);
  float cosine = clamp(dot(ray.direction.xy, sun.xy) / max(across, 1e-9), -1.0, 1.0);
  float x = texture_from_unit(unit_from_azimuth(cosine), sky_view_size.x);
  vec2 place = vec2((float(i) + x) / float(kSuns), texture_from_view(ray.h, ray.mu, ray.hits_ground, sky_view_size.y,
                                                                     sky_view_size.z, bottom_km, thickness_km));
  return WholeRay(Scattering(exp(texture(view_air, place)), exp(texture(view_aerosol, place))),
                  texture(view_depth, place));
#endif
}
#endif
