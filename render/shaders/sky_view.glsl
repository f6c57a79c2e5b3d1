// SPDX-License-Identifier: Apache-2.0
// The scattered light of whole rays from the eye, and their optical depth, as a picture over all directions: what every
// pixel would look up in the tables at the same height, made once a frame. Rows as in the scattering table, columns by the
// azimuth from the sun, each sun its own. A multiple of the table's texels, so that the two interpolate alike. Not for an eye
// high above, FROM_ABOVE: there the sun's height at the far end of a ray changes too fast with the azimuth.
// HILLAIRE: the radiances of his sky-view look-up, of rays to the sky alone and by its mapping, for every eye in the air.
// Not below, in a branch: files are included once.
#include "render/shaders/densities.glsl"
#include "render/shaders/view_ray.glsl"
#include "model/shared/bodare_mapping.glsl"
#include "model/shared/bruneton_mapping.glsl"
#ifdef HILLAIRE
#include "render/shaders/hillaire.glsl"
#endif
#if defined(BODARE) && !defined(VOLUME)
#include "render/shaders/bodare_march.glsl"
#endif
#ifdef ONEIL
#include "render/shaders/oneil.glsl"
#endif

const vec3 sky_view_size = vec3(SKY_VIEW_SIZE);  // columns of a sun, rows of rays to the ground, rows of rays to the sky

// Where a direction lies in a picture of such columns and rows (ground, sky), 0..1.
vec2 place_in_view(ViewRay ray, vec3 sun, vec3 size) {
  float across = length(ray.direction.xy) * length(sun.xy);
  float cosine = clamp(dot(ray.direction.xy, sun.xy) / max(across, 1e-9), -1.0, 1.0);
  return vec2(texture_from_unit(unit_from_azimuth(cosine), size.x),
              texture_from_view(ray.h, ray.mu, ray.hits_ground, size.y, size.z, bottom_km, thickness_km, deck_km()));
}

// The ray of a column and a row, counted from 0.
ViewRay ray_in_view(vec2 texel, vec3 sun, vec3 size) {
  float turn_cosine = cosine_from_azimuth_unit(texel.x / (size.x - 1.0));
  float turn_sine = sqrt(max(1.0 - turn_cosine * turn_cosine, 0.0));
  bool hits_ground = texel.y < size.y - 0.5;
  float h = min(camera_km, thickness_km);
  float mu = mu_from_texture((texel.y + 0.5) / (size.y + size.z), h, size.y, size.z, bottom_km, thickness_km, deck_km());
  float sine = sqrt(max(1.0 - mu * mu, 0.0));
  vec2 sunward = length(sun.xy) > 1e-9 ? normalize(sun.xy) : vec2(1.0, 0.0);
  vec2 across = turn_cosine * sunward + turn_sine * vec2(-sunward.y, sunward.x);
  return ViewRay(vec3(0.0), vec3(sine * across, mu), true, hits_ground, 0.0, h, mu,
                 distance_to_inner_sphere(bottom_km, h, mu, 0.0));
}

#if !defined(SKY_VIEW_WRITE) && !defined(VOLUME_WRITE)
#if defined(SKY_RAYS) && !defined(HILLAIRE) && !defined(ONEIL)
#include "render/shaders/sky_rays.glsl"
#endif
layout(binding = 9) uniform sampler2D view_air;      // logarithm of the amplitude; HILLAIRE: radiance of the sky
layout(binding = 10) uniform sampler2D view_aerosol;  // the same of single scattering by the other classes
layout(binding = 11) uniform sampler2D view_depth;    // optical depth to the top, of rays that miss the ground

struct WholeRay {
  Scattering scattering;
  vec4 depth;
};

WholeRay whole_ray(ViewRay ray, Place start, vec3 sun, float nu, int i) {
#if defined(SKY_RAYS) && defined(HILLAIRE)
  vec4 depth = optical_depth_past_ground(ray.h, ray.mu);
#ifdef FROM_ABOVE
  return WholeRay(hillaire_ray(start, nu), depth);
#else
  // The picture holds radiances, with the phase functions of its texels.
  vec2 place = hillaire_place_in_view(ray.h, ray.mu, cosine_of_azimuth(ray.mu, sun.z, nu));
  Scattering light = march_begin().light;
  light.rayleigh_like = texture(view_air, vec2((float(i) + place.x) / float(kSuns), place.y)) /
                        rayleigh_phase(depolarisation, nu);
  return WholeRay(light, depth);
#endif
#elif defined(SKY_RAYS) && defined(ONEIL)
  return WholeRay(oneil_ray(start, nu), optical_depth_past_ground(ray.h, ray.mu));
#elif defined(SKY_RAYS)
  return WholeRay(sky_ray_scattering(start, nu), optical_depth_past_ground(ray.h, ray.mu));
#elif defined(FROM_ABOVE)
  return WholeRay(scattering(start, nu, ray.hits_ground),
                  optical_depth_past_ground(ray.h, ray.mu));
#else
  vec2 place = place_in_view(ray, sun, sky_view_size);
  // Pictures of the suns lie side by side, of the first class, then of the next.
  Scattering light;
  light.rayleigh_like = texture(view_air, vec2(in_class(0, (float(i) + place.x) / float(kSuns)), place.y));
  for (int c = 0; c < kClasses; ++c) {
    light.single[c] = texture(view_aerosol, vec2(in_class(c, (float(i) + place.x) / float(kSuns)), place.y));
  }
  return WholeRay(exponential(light),
                  texture(view_depth, vec2(in_class(0, (float(i) + place.x) / float(kSuns)), place.y)));
#endif
}
#endif
