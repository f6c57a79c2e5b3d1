// SPDX-License-Identifier: Apache-2.0
// A ray of the picture and the part of it that lies in the atmosphere (Sperlhofer 2011, 4.6.2): from the eye, or from
// where it enters. Camera frame: z up at the camera, x toward the sun, y to the left of it; kilometres.
#include "render/shaders/atmosphere.glsl"

#ifdef SECOND_SUN
const int kSuns = 2;
#else
const int kSuns = 1;
#endif

layout(std140, binding = 1) uniform View {
  mat3 site_from_view;
  mat3 planet_from_site;
  vec2 tangent;       // of half the field of view
  float camera_km;    // height of the camera
  float near_km;
  float pixel_angle;  // rad
  float volume_km;    // the farthest distance of the volume
  vec4 suns[kSuns];   // unit vector in the camera frame; irradiance as a share of the first sun's
};

// The ray through a point of the picture, which runs from -1 to 1: of length 1 along the view's axis, so that it is linear
// over the picture. Camera frame.
vec3 ray_through(vec2 screen) { return site_from_view * vec3(screen * tangent, -1.0); }

struct ViewRay {
  vec3 direction;
  bool air;          // meets the atmosphere
  bool hits_ground;  // its sphere
  float entry;       // distance to the beginning of the part in the atmosphere
  float h, mu;       // height and cosine of the zenith angle there
};

ViewRay view_ray(vec3 direction) {
  float r0 = bottom_km + camera_km;
  // The impact parameter keeps the digits that the cosine of the zenith angle would lose.
  float impact = r0 * length(direction.xy);
  ViewRay ray = ViewRay(direction, true, direction.z < 0.0 && impact < bottom_km, 0.0, camera_km, direction.z);
  if (camera_km > thickness_km) {
    float top = bottom_km + thickness_km;
    float half_chord = sqrt(max((top - impact) * (top + impact), 0.0));
    ray.air = direction.z < 0.0 && impact < top;
    ray.entry = -r0 * direction.z - half_chord;
    ray.h = thickness_km;
    ray.mu = -half_chord / top;
  }
  return ray;
}

// Where the ray begins in the air, with the sun's height there.
Place place_of(ViewRay ray, vec3 sun, float nu) {
  if (ray.entry == 0.0) return Place(ray.h, ray.mu, sun.z);
  float r0 = bottom_km + camera_km;
  return Place(ray.h, ray.mu, clamp((r0 * sun.z + ray.entry * nu) / (bottom_km + ray.h), -1.0, 1.0));
}
