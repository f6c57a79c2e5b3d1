// SPDX-License-Identifier: Apache-2.0
// Light scattered into paths from the eye and their transmittance in a volume of 32 x 32 x 16 (Bodare & Sandberg 2014,
// 6.4.2); of the transmittance one slice across, for it is the same in all azimuths. Deviations: the directions are those of
// sky_view.glsl, by the azimuth from the sun and apart above and below the horizon, which a volume over the frustum would
// mix (half of the light of a pixel beside it); the volume holds logarithms, of the extinction per kilometre and of the
// light over the share of its passing light that a path takes, which is about the source of light along it: smooth where a
// path begins and where haze lets no more light through; and the two kinds of scattering apart, so that the phase functions
// stay those of the pixel.
#include "render/shaders/sky_view.glsl"

const vec3 kVolumeSize = vec3(32.0, 32.0, 16.0);
const vec3 kVolumeView = vec3(32.0, 18.0, 14.0);  // columns, rows of rays to the ground, rows of rays to the sky

// The slices lie at the same shares of a ray's way to the ground, so that rays that go deep are not mixed with rays that
// end before; of a ray that misses it, of the way to the farthest that is seen.
float longest_path(ViewRay ray) {
  float to_top = distance_to_outer_sphere(bottom_km, ray.h, ray.mu, thickness_km);
  return ray.hits_ground ? ray.to_ground : min(to_top, volume_km);
}

// Distance of a slice as a share of that way, and its inverse as a texture coordinate.
float slice_share(float slice) {
  float x = (slice + 0.5) / (kVolumeSize.z - 0.5);
  return x * x;
}
float slice_coordinate(float share) { return sqrt(share) * ((kVolumeSize.z - 0.5) / kVolumeSize.z); }

#ifndef VOLUME_WRITE
layout(binding = 15) uniform sampler3D air_volume;
layout(binding = 16) uniform sampler3D aerosol_volume;
layout(binding = 17) uniform sampler2D extinction_volume;  // rows and slices

struct VolumeLight {
  Scattering scattering;
  vec4 transmittance;
};

VolumeLight volume_light(ViewRay ray, float d) {
  float slice = slice_coordinate(min(d / longest_path(ray), 1.0));
  vec3 place = vec3(place_in_view(ray, suns[0].xyz, kVolumeView), slice);
  Scattering light;
  light.rayleigh_like = texture(air_volume, place);
  for (int c = 0; c < kClasses; ++c) {
    // A class keeps to its own slices.
    light.single[c] = texture(aerosol_volume, vec3(place.xy, in_class(c, max(place.z, 0.5 / kVolumeSize.z))));
  }
  vec4 depth = d * exp(texture(extinction_volume, place.yz));
  return VolumeLight(scaled(exponential(light), share_taken(depth)), exp(-depth));
}
#endif
