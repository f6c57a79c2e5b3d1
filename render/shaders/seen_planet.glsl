// SPDX-License-Identifier: Apache-2.0
// What an eye sees along a ray, at the four wavelengths per unit solar irradiance: the air, the ground as a plain Lambertian
// sphere, and apart from them the sun's disc. Directions have z up at the eye; kilometres.
#include "render/shaders/surface_light.glsl"
#include "render/shaders/ray_in_air.glsl"

struct SeenLight {
  vec4 light;  // of air and ground
  vec4 disc;   // of the sun
};

SeenLight seen_planet(vec3 direction, float eye_km, vec3 sun) {
  ViewRay ray = ray_in_air(direction, eye_km);
  // In the air the cosine of the zenith angle has the digits, from afar the impact parameter.
  if (eye_km < thickness_km) ray.hits_ground = ray_hits_ground(eye_km, ray.mu, bottom_km);
  float nu = clamp(dot(ray.direction, sun), -1.0, 1.0);
  Place start = where_it_begins(ray, eye_km, sun, nu);
  SeenLight seen;
  seen.light = grey(0.0);
  vec4 transmittance = grey(1.0);
  if (ray.air) {
    seen.light = radiance(scattering(start, nu, ray.hits_ground), nu);
    if (ray.hits_ground) {
      Place ground = place_along(start, nu, ray.to_ground);
      ground.h = 0.0;
      vec3 up = normalize(vec3(0.0, 0.0, bottom_km + eye_km) + (ray.entry + ray.to_ground) * ray.direction);
      vec4 reflected = (kInversePi * ground_albedo) * surface_irradiance(ground, up, up, sun, 1.0);
      seen.light += transmittance_between(start, ground, true) * reflected;
      transmittance = grey(0.0);
    } else {
      transmittance = exp(-optical_depth_past_ground(start.h, start.mu));
    }
  }
  float away = 2.0 * asin(clamp(0.5 * length(ray.direction - sun), 0.0, 1.0)) / kSunRadius;
  seen.disc = transmittance * (disc_brightness(min(away, 1.0)) / kSunSolidAngle);
  return seen;
}
