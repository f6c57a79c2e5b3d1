// SPDX-License-Identifier: Apache-2.0
// G-buffer as terrain.frag fills it; a face seen from behind turns its normal to the eye.
#include "render/shaders/gbuffer.glsl"

in vec3 site_normal;
in vec4 object_reflectance;

void main() {
  vec3 normal = normalize(site_normal);
  write_gbuffer(gl_FrontFacing ? normal : -normal, object_reflectance);
}
