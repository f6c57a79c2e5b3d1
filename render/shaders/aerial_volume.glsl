// SPDX-License-Identifier: Apache-2.0
// Light scattered into paths and their transmittance in a volume over the view frustum (Bodare & Sandberg 2014, 6.4.2):
// directions at the texels of x and y, distances along z, more densely near the eye. Deviation: the volume holds the
// logarithms of means per kilometre, which are smooth where a path begins and across the horizon's exponentials, and the
// two kinds of scattering apart, so that the phase functions stay those of the pixel.
#include "render/shaders/view_ray.glsl"

const vec3 kVolumeSize = vec3(32.0, 32.0, 16.0);

// Distance of a slice and its inverse, as a texture coordinate.
float slice_distance(float slice) {
  float x = (slice + 0.5) / (kVolumeSize.z - 0.5);
  return volume_km * x * x;
}
float slice_coordinate(float d) {
  return sqrt(d / volume_km) * (kVolumeSize.z - 0.5) / kVolumeSize.z;
}

#ifndef VOLUME_WRITE
layout(binding = 14) uniform sampler3D air_volume;
layout(binding = 15) uniform sampler3D aerosol_volume;
layout(binding = 16) uniform sampler3D extinction_volume;

struct VolumeLight {
  Scattering scattering;
  vec4 transmittance;
};

VolumeLight volume_light(vec2 screen, float d) {
  vec2 across = (0.5 + (0.5 * screen + 0.5) * (kVolumeSize.xy - 1.0)) / kVolumeSize.xy;
  vec3 place = vec3(across, slice_coordinate(min(d, volume_km)));
  return VolumeLight(Scattering(d * exp(texture(air_volume, place)), d * exp(texture(aerosol_volume, place))),
                   exp(-d * exp(texture(extinction_volume, place))));
}
#endif
