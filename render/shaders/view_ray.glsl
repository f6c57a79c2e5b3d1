// SPDX-License-Identifier: Apache-2.0
// The rays of a picture. Camera frame: z up at the camera, x toward the sun, y to the left of it; kilometres.
#include "render/shaders/ray_in_air.glsl"

const float kInfinity = uintBitsToFloat(0x7f800000u);

#ifdef SECOND_SUN
const int kSuns = 2;
#else
const int kSuns = 1;
#endif

// Angular radius of a sun's disc, or of the moon's that is the second light.
float disc_radius(int i) {
#ifdef MOON_RADIUS
  if (i == 1) return float(MOON_RADIUS);
#endif
  return kSunRadius;
}
float disc_solid_angle(int i) {
#ifdef MOON_RADIUS
  if (i == 1) return 4.0 * kPi * pow(sin(0.5 * float(MOON_RADIUS)), 2.0);
#endif
  return kSunSolidAngle;
}

// Of each sun where and how its disc is refracted, render/gl/atmosphere/disc_bending.h; n - 1 of the air at the ground and the
// height over which it falls by e.
#ifdef REFRACTION
#define BENDING_CONSTANTS(EACH) EACH(vec4[2 * kSuns], bending) EACH(vec2, refractive_air)
#else
#define BENDING_CONSTANTS(EACH)
#endif

// Of a frame. Half the field of view; the camera's height; a pixel's angle, rad; the farthest distance of the volume; the variance of the sea's slopes; of each
// sun the unit vector in the camera frame and the illuminance as a share of the first one's.
#define VIEW_CONSTANTS(EACH)     \
  EACH(mat3, site_from_view)     \
  EACH(mat3, planet_from_site)   \
  EACH(vec2, tangent)            \
  EACH(float, camera_km)         \
  EACH(float, near_km)           \
  EACH(float, pixel_angle)       \
  EACH(float, volume_km)         \
  EACH(float, slope_variance)    \
  EACH(vec4[kSuns], suns)        \
  BENDING_CONSTANTS(EACH)
CONSTANTS(1, View, VIEW_CONSTANTS)

// The ray through a point of the picture, which runs from -1 to 1: of length 1 along the view's axis, so that it is linear
// over the picture. Camera frame.
vec3 ray_through(vec2 screen) { return site_from_view * vec3(screen * tangent, -1.0); }

ViewRay view_ray(vec3 direction) { return ray_in_air(direction, camera_km); }

Place place_of(ViewRay ray, vec3 sun, float nu) { return where_it_begins(ray, camera_km, sun, nu); }
