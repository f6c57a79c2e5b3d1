// SPDX-License-Identifier: Apache-2.0
// What a renderer of other people asks for. Vectors are of length 1 with z up at the eye, or at the point that is asked about;
// heights above the planet's bottom radius and distances in kilometres. Colours are linear, in the primaries and the units that
// the first lines of the file name; those outside the primaries become less saturated, of the same luminance.
// EXACT_FILTER, defined before this file: texels are interpolated in full precision, as aerial perspective near the eye needs
// on a GPU.
#include "render/shaders/seen_planet.glsl"

const vec4 red_from_nodes = vec4(RED_FROM_NODES);
const vec4 green_from_nodes = vec4(GREEN_FROM_NODES);
const vec4 blue_from_nodes = vec4(BLUE_FROM_NODES);
const vec4 luminance_from_nodes = vec4(LUMINANCE_FROM_NODES);

// Of values at the four wavelengths.
vec3 skyfit_color(vec4 nodes) {
  vec3 color = vec3(dot(red_from_nodes, nodes), dot(green_from_nodes, nodes), dot(blue_from_nodes, nodes));
  float luminance = dot(luminance_from_nodes, nodes), least = min(color.r, min(color.g, color.b));
  if (least >= 0.0 || luminance <= 0.0) return max(color, 0.0);
  vec3 grey_of_it = vec3(luminance, luminance, luminance);
  return max(mix(grey_of_it, color, luminance / (luminance - least)), 0.0);
}

// Luminance, cd/m^2, of air and ground toward `view`, of an eye inside the atmosphere or outside; without the sun's disc. The
// ground is a smooth sphere with the preset's albedo.
vec3 skyfit_luminance(vec3 view, vec3 sun, float eye_km) { return skyfit_color(seen_planet(view, eye_km, sun).light); }

// Luminance, cd/m^2, of the sun's disc toward `view`; 0 beside it.
vec3 skyfit_sun_luminance(vec3 view, vec3 sun, float eye_km) {
  if (0.5 * length(view - sun) > sin(0.5 * kSunRadius)) return vec3(0.0, 0.0, 0.0);
  return skyfit_color(seen_planet(view, eye_km, sun).disc);
}

// Of a point in the atmosphere: illuminance of the sun's beam on a surface that faces it, and of the sky on a horizontal one,
// lx. `sun_z` is the cosine of the sun's zenith angle there.
vec3 skyfit_sun_illuminance(float sun_z, float height_km) { return skyfit_color(sun_transmittance(height_km, sun_z)); }
vec3 skyfit_sky_illuminance(float sun_z, float height_km) { return skyfit_color(sky_irradiance(height_km, sun_z)); }

// Of a thing so far from the eye along `view`: luminance seen = transmittance times the thing's own + in_scatter, cd/m^2. The
// transmittance is that of sunlight's red, green and blue.
void skyfit_aerial_perspective(vec3 view, vec3 sun, float eye_km, float distance_km, OUT(vec3) in_scatter,
                               OUT(vec3) transmittance) {
  in_scatter = vec3(0.0, 0.0, 0.0);
  transmittance = vec3(1.0, 1.0, 1.0);
  ViewRay ray = ray_in_air(view, eye_km);
  float in_air = distance_km - ray.entry;
  if (!ray.air || in_air <= 0.0) return;
  if (ray.hits_ground) in_air = min(in_air, ray.to_ground);
  float nu = clamp(dot(view, sun), -1.0, 1.0);
  Place start = where_it_begins(ray, eye_km, sun, nu);
  Place end = place_along(start, nu, in_air);
  vec4 through = transmittance_between(start, end, ray.hits_ground);
  Scattering before =
      scattering_before(scattering(start, nu, ray.hits_ground), through, scattering(end, nu, ray.hits_ground));
  in_scatter = skyfit_color(radiance(before, nu));
  transmittance = clamp(skyfit_color(through) / skyfit_color(grey(1.0)), 0.0, 1.0);
}
