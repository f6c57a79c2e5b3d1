// SPDX-License-Identifier: Apache-2.0
// Fills the volume of aerial_volume.glsl from the atmosphere's tables, for the first sun.
#define VOLUME_WRITE
#include "render/shaders/aerial_volume.glsl"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;
layout(rgba32f, binding = 0) writeonly uniform image3D air_means;
layout(rgba32f, binding = 1) writeonly uniform image3D aerosol_means;
layout(rgba32f, binding = 2) writeonly uniform image3D extinction_means;

void main() {
  ivec3 texel = ivec3(gl_GlobalInvocationID);
  vec3 sun = suns[0].xyz;
  ViewRay ray = ray_in_view(vec2(texel.xy), sun, kVolumeView);
  float nu = clamp(dot(ray.direction, sun), -1.0, 1.0);
  Place start = place_of(ray, sun, nu);
  float d = slice_share(float(texel.z)) * longest_path(ray);
  Place end = place_along(start, nu, d);
  vec4 depth_between = optical_depth_between(start, end, ray.hits_ground);
  Scattering path = scattering_before(scattering(start, nu, ray.hits_ground), exp(-depth_between),
                                      scattering(end, nu, ray.hits_ground));
  vec4 least = vec4(1e-12);
  imageStore(air_means, texel, log(max(path.rayleigh_like / d, least)));
  imageStore(aerosol_means, texel, log(max(path.single_mie / d, least)));
  imageStore(extinction_means, texel, log(max(depth_between / d, least)));
}
