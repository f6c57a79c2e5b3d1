// SPDX-License-Identifier: Apache-2.0
// A thing beside the ground into the G-buffer, as terrain.vert does the ground.
#include "render/shaders/seen_point.glsl"
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 reflectance;

uniform mat3 site_from_object;  // scales to kilometres
uniform vec3 offset_km;         // from the camera
uniform mat3 view_from_site;
uniform mat3 planet_from_site;
uniform vec2 tangent;
uniform float near_km;

out vec3 planet_normal;
out vec4 object_reflectance;

void main() {
  vec3 site = site_from_object * position + offset_km;
  vec3 view = view_from_site * seen_point(site, vec3(0.0, 0.0, 1.0));
  gl_Position = vec4(view.xy / tangent, near_km, -view.z);
  planet_normal = planet_from_site * (site_from_object * normal);
  object_reflectance = reflectance;
}
