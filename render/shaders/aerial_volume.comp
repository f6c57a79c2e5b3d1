// SPDX-License-Identifier: Apache-2.0
// Fills the volume of aerial_volume.glsl from the atmosphere's tables, for the first sun.
#define VOLUME_WRITE
#include "render/shaders/aerial_volume.glsl"

layout(local_size_x = 8, local_size_y = 8, local_size_z = 1) in;
layout(rgba32f, binding = 0) writeonly uniform image3D air_sources;
layout(rgba32f, binding = 1) writeonly uniform image3D aerosol_sources;
layout(rgba32f, binding = 2) writeonly uniform image2D extinction_means;

void main() {
  ivec2 texel = ivec2(gl_GlobalInvocationID);
  vec3 sun = suns[0].xyz;
  ViewRay ray = ray_in_view(vec2(texel), sun, kVolumeView);
  float nu = clamp(dot(ray.direction, sun), -1.0, 1.0);
  Place start = place_of(ray, sun, nu);
#if defined(HILLAIRE) || defined(BODARE)
  March march = march_begin();
  float marched = 0.0;
#else
  Scattering whole = scattering(start, nu, ray.hits_ground);
#endif
  const vec4 least = vec4(1e-12);
  for (int slice = 0; slice < int(kVolumeSize.z); ++slice) {
    float d = slice_share(float(slice)) * longest_path(ray);
    Place end = place_along(start, nu, d);
    vec4 depth_between = max(optical_depth_between(start, end, ray.hits_ground), least * d);
    vec4 taken = share_taken(depth_between);
#ifdef HILLAIRE
    float half_way = 0.5 * (marched + d);  // two steps for a slice
    march = march_step(march_step(march, start, nu, marched, half_way), start, nu, half_way, d);
    marched = d;
    Scattering path = march.light;
#elif defined(BODARE)
    march = march_step(march, start, nu, marched, d, ray.hits_ground);
    marched = d;
    Scattering path = march.light;
#else
    Scattering path = scattering_before(whole, exp(-depth_between), scattering(end, nu, ray.hits_ground));
#endif
    imageStore(air_sources, ivec3(texel, slice), log(max(path.rayleigh_like / taken, least)));
    for (int c = 0; c < kClasses; ++c) {
      imageStore(aerosol_sources, ivec3(texel, slice + c * int(kVolumeSize.z)), log(max(path.single[c] / taken, least)));
    }
    if (texel.x == 0) imageStore(extinction_means, ivec2(texel.y, slice), log(depth_between / d));
  }
}
