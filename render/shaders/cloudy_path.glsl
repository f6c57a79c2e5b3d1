// SPDX-License-Identifier: Apache-2.0
// The light of a path on which sheets of clouds lie (clouds.glsl) and, with CLOUD_SHADOWS, shade the air (shaded_air.glsl).

const int kCloudShadowSteps = 32;

// Of the light behind a cloud the cloud lets the rest pass; from the farthest sheet to the nearest. `in_scatter`: of the air up
// to the path's end, as of a sky without clouds; becomes what they leave of it. Returns what they scatter themselves.
vec4 among_clouds(inout vec4 in_scatter, ViewRay ray, Place start, float nu, float length_km, MetClouds met, float spread,
                  int sun, int shadow_steps) {
#ifdef CLOUD_SHADOWS
  LightUnderClouds beam = light_under_clouds(ray, start, nu, length_km, met, sun, shadow_steps);
  in_scatter = without_shaded(in_scatter, beam.path);
#endif
  vec4 of_clouds = vec4(0.0);
  for (int c = CLOUDS - 1; c >= 0; --c) {
    float opacity = met.opacities[c];
    if (opacity <= 0.0) continue;
    float d = met.distances[c] - ray.entry;
    Place at = place_along(start, nu, d);
#ifdef CLOSED_FORM
    vec4 dimming = closed_form_through(start, at.h, d);
    vec4 before = closed_form_inscatter(start, nu, at.h, d);
#else
    vec4 dimming = transmittance_between(start, at, ray.hits_ground);
    vec4 before = radiance(
        scattering_before(scattering(start, nu, ray.hits_ground), dimming, scattering(at, nu, ray.hits_ground)), nu);
#endif
#ifdef CLOUD_SHADOWS
    before = without_shaded(before, beam.before[c]);
#endif
#ifndef FORMULA_SKY  // whose sky is not the sum of its paths
    before = min(before, in_scatter);
#endif
    in_scatter = mix(in_scatter, before, opacity);
    float lit = clear_of_clouds(ray.eye + met.distances[c] * ray.direction, at, suns[sun].xyz, c, met.distances[c] * spread);
    of_clouds = mix(of_clouds, dimming * cloud_radiance(cloud_sheets[c].x, at, ray.h, lit), opacity);
  }
  return of_clouds;
}
