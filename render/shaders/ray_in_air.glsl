// SPDX-License-Identifier: Apache-2.0
// A ray from an eye and the part of it that lies in the atmosphere (Sperlhofer 2011, 4.6.2): from the eye, or from where it
// enters. Directions have z up at the eye; kilometres.
#include "render/shaders/atmosphere.glsl"

struct ViewRay {
  vec3 eye;  // relative to the camera
  vec3 direction;
  bool air;          // meets the atmosphere
  bool hits_ground;  // its sphere
  float entry;       // distance to the beginning of the part in the atmosphere
  float h, mu;       // height and cosine of the zenith angle there
  float to_ground;   // distance from there, where it hits the ground
};

ViewRay ray_in_air(vec3 direction, float eye_km) {
  float r0 = bottom_km + eye_km;
  // The impact parameter keeps the digits that the cosine of the zenith angle would lose.
  float impact = r0 * length(direction.xy);
  ViewRay ray;
  ray.eye = vec3(0.0);
  ray.direction = direction;
  ray.air = true;
  ray.hits_ground = direction.z < 0.0 && impact < bottom_km;
  ray.entry = 0.0;
  ray.h = eye_km;
  ray.mu = direction.z;
#ifndef VOLUME  // the eye is in the air
  if (eye_km > thickness_km) {
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

// With the sun's height there. `nu` is the cosine of the angle between ray and sun.
Place where_it_begins(ViewRay ray, float eye_km, vec3 sun, float nu) {
  if (ray.entry == 0.0) return place_at(ray.h, ray.mu, sun.z);
  float r0 = bottom_km + eye_km;
  return place_at(ray.h, ray.mu, clamp((r0 * sun.z + ray.entry * nu) / (bottom_km + ray.h), -1.0, 1.0));
}
