// SPDX-License-Identifier: Apache-2.0
// Where an eye in or above air sees a point: by --refraction higher than a straight ray shows it.
#define Number float
#define OUT(T) out T
#include "model/shared/geometry.glsl"
#include "model/shared/seen_refracted.glsl"

uniform vec4 eye_in_air;  // Projection::eye_in_air

// At its distance. `point` from the eye in kilometres, `up` the zenith of the eye.
vec3 seen_point(vec3 point, vec3 up) {
  if (eye_in_air.z <= 0.0) return point;
  float distance = length(point), rise = dot(point, up);
  vec3 level = point - rise * up;
  float across = length(level);
  if (across < 1e-6 * distance) return point;
  float lift = lift_by_air(eye_in_air.y, rise / distance, distance, eye_in_air.x, eye_in_air.z, eye_in_air.w);
  return cos(lift) * point + sin(lift) * (across * up - rise / across * level);
}
