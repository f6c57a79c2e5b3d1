// SPDX-License-Identifier: Apache-2.0
// A square that faces the camera, at the depth of the sky and as large as a sun's disc; an instance for each sun.
#include "render/shaders/pixel_ray.glsl"

void main() {
  vec3 sun = suns[gl_InstanceID].xyz;
#ifdef REFRACTION
  float zenith = bending[2 * gl_InstanceID].x;
  if (sun.xy != vec2(0.0)) sun = vec3(sin(zenith) * normalize(sun.xy), cos(zenith));
#endif
  vec3 right = normalize(cross(sun, abs(sun.z) < 0.9 ? vec3(0.0, 0.0, 1.0) : vec3(1.0, 0.0, 0.0)));
  vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  // The disc's edge is softened over a pixel.
  vec2 offset = tan(disc_radius(gl_InstanceID) + pixel_angle) * corner;
  vec3 eye = (sun + offset.x * right + offset.y * cross(right, sun)) * site_from_view;
  pass_ray(eye.xy / (tangent * -eye.z));
  pass_constants();
  gl_Position = vec4(eye.xy / tangent, 0.0, -eye.z);
}
