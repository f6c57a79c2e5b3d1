// SPDX-License-Identifier: Apache-2.0
// A ray of the picture and the part of it that lies in the atmosphere (Sperlhofer 2011, 4.6.2): from the eye, or from
// where it enters. Camera frame: z up at the camera, x toward the sun, y to the left of it; kilometres.
#include "render/shaders/atmosphere.glsl"

#ifdef SECOND_SUN
const int kSuns = 2;
#else
const int kSuns = 1;
#endif

// Of a frame. Half the field of view; the camera's height; a pixel's angle, rad; the farthest distance of the volume; the variance of the sea's slopes; of each
// sun the unit vector in the camera frame and the irradiance as a share of the first one's.
#define VIEW_CONSTANTS(HOW)  \
  HOW mat3 site_from_view;   \
  HOW mat3 planet_from_site; \
  HOW vec2 tangent;          \
  HOW float camera_km;       \
  HOW float near_km;         \
  HOW float pixel_angle;     \
  HOW float volume_km;       \
  HOW float slope_variance;  \
  HOW vec4 suns[kSuns];
CONSTANTS(1, View, VIEW_CONSTANTS)

// The ray through a point of the picture, which runs from -1 to 1: of length 1 along the view's axis, so that it is linear
// over the picture. Camera frame.
vec3 ray_through(vec2 screen) { return site_from_view * vec3(screen * tangent, -1.0); }

struct ViewRay {
  vec3 direction;
  bool air;          // meets the atmosphere
  bool hits_ground;  // its sphere
  float entry;       // distance to the beginning of the part in the atmosphere
  float h, mu;       // height and cosine of the zenith angle there
  float to_ground;   // distance from there, where it hits the ground
};

ViewRay view_ray(vec3 direction) {
  float r0 = bottom_km + camera_km;
  // The impact parameter keeps the digits that the cosine of the zenith angle would lose.
  float impact = r0 * length(direction.xy);
  ViewRay ray = ViewRay(direction, true, direction.z < 0.0 && impact < bottom_km, 0.0, camera_km, direction.z, 0.0);
#ifndef VOLUME  // the eye is in the air
  if (camera_km > thickness_km) {
    float top = bottom_km + thickness_km;
    float half_chord = sqrt(max((top - impact) * (top + impact), 0.0));
    ray.air = direction.z < 0.0 && impact < top;
    ray.entry = -r0 * direction.z - half_chord;
    ray.h = thickness_km;
    ray.mu = -half_chord / top;
  }
#endif
  ray.to_ground = distance_to_inner_sphere(bottom_km, ray.h, ray.mu, 0.0);
  return ray;
}

// Where the ray begins in the air, with the sun's height there.
Place place_of(ViewRay ray, vec3 sun, float nu) {
  if (ray.entry == 0.0) return Place(ray.h, ray.mu, sun.z);
  float r0 = bottom_km + camera_km;
  return Place(ray.h, ray.mu, clamp((r0 * sun.z + ray.entry * nu) / (bottom_km + ray.h), -1.0, 1.0));
}
