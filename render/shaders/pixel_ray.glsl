// SPDX-License-Identifier: Apache-2.0
// What the fragments of a pass over the picture get from the corners: the ray through a pixel, and what is the same for all.
#include "render/shaders/view_ray.glsl"
#include "render/shaders/materials.glsl"

noperspective out vec3 site_ray;    // camera frame
noperspective out vec3 planet_ray;  // planet's axes

out View { VIEW_CONSTANTS(flat) } view;
out Atmosphere { ATMOSPHERE_CONSTANTS(flat) } atmosphere;
out Materials { MATERIAL_CONSTANTS(flat) } material;

void pass_ray(vec2 screen) {
  site_ray = ray_through(screen);
  planet_ray = planet_from_site * site_ray;
}

void pass_constants() {
  view.site_from_view = site_from_view;
  view.planet_from_site = planet_from_site;
  view.tangent = tangent;
  view.camera_km = camera_km;
  view.near_km = near_km;
  view.pixel_angle = pixel_angle;
  view.volume_km = volume_km;
  view.slope_variance = slope_variance;
  view.suns = suns;
#ifdef REFRACTION
  view.bending = bending;
#endif
  atmosphere.depolarisation = depolarisation;
  atmosphere.phase_parameters = phase_parameters;
  atmosphere.ground_albedo = ground_albedo;
#ifdef ENCODED
  atmosphere.texel_scale = texel_scale;
  atmosphere.texel_offset = texel_offset;
#endif
#ifdef CLOSED_FORM
  atmosphere.air_beta = air_beta;
  atmosphere.aerosol_beta = aerosol_beta;
#ifdef NIELSEN
  atmosphere.nielsen_haze = nielsen_haze;
#else
  atmosphere.scale_heights_m = scale_heights_m;
#endif
#ifdef PREETHAM
  atmosphere.turbidity = turbidity;
  atmosphere.radiance_from_xyz = radiance_from_xyz;
#endif
#endif
  material.grain_phase = grain_phase;
  material.grains_per_km = grains_per_km;
  material.crag_phase = crag_phase;
  material.crags_per_km = crags_per_km;
  material.far_crag_phase = far_crag_phase;
  material.far_crags_per_km = far_crags_per_km;
  material.grain_mean = grain_mean;
}
