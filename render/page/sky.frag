// SPDX-License-Identifier: Apache-2.0
// What a pixel of the page sees, at the four wavelengths per unit solar irradiance: the air, the ground as a plain
// Lambertian sphere, and apart from them the sun's disc.
#include "render/shaders/surface_light.glsl"
#include "render/shaders/view_ray.glsl"

in vec2 screen;
layout(location = 0) out vec4 light;
layout(location = 1) out vec4 disc;

void main() {
  ViewRay ray = view_ray(normalize(ray_through(screen)));
  // In the air the cosine of the zenith angle has the digits, from afar the impact parameter.
  if (camera_km < thickness_km) ray.hits_ground = ray_hits_ground(camera_km, ray.mu, bottom_km);
  vec3 sun = suns[0].xyz;
  float nu = clamp(dot(ray.direction, sun), -1.0, 1.0);
  Place start = place_of(ray, sun, nu);
  light = vec4(0.0);
  vec4 transmittance = vec4(1.0);
  if (ray.air) {
    light = radiance(scattering(start, nu, ray.hits_ground), nu);
    if (ray.hits_ground) {
      Place ground = place_along(start, nu, ray.to_ground);
      ground.h = 0.0;
      vec3 up = normalize(vec3(0.0, 0.0, bottom_km + camera_km) + (ray.entry + ray.to_ground) * ray.direction);
      vec4 reflected = (kInversePi * ground_albedo) * surface_irradiance(ground, up, up, sun, 1.0);
      light += transmittance_between(start, ground, true) * reflected;
      transmittance = vec4(0.0);
    } else {
      transmittance = exp(-optical_depth_past_ground(start.h, start.mu));
    }
  }
  float away = 2.0 * asin(clamp(0.5 * length(ray.direction - sun), 0.0, 1.0)) / kSunRadius;
  disc = transmittance * (disc_brightness(min(away, 1.0)) / kSunSolidAngle);
}
