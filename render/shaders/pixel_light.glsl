// SPDX-License-Identifier: Apache-2.0
// What a pixel sees (Sperlhofer 2011, 4.6.2): light reflected by what is there, dimmed on the way, plus the light that the
// air scatters into the path; where there is something (SURFACE), in the sky, and in the suns (DISC). See atmosphere_pass.h
// for the other variants.
#include "render/shaders/sky_view.glsl"
#include "render/shaders/gbuffer.glsl"
#include "render/shaders/straight_ray.glsl"
#include "render/shaders/surface_light.glsl"
#ifdef SURFACE
#include "render/shaders/materials.glsl"
#endif
#ifdef VOLUME
#include "render/shaders/aerial_volume.glsl"
#endif
#ifdef CLOUDS
#include "render/shaders/clouds.glsl"
#else
struct MetClouds {
  float clear;
};
#endif
#if defined(SHADOWS) || defined(CLOUD_SHADOWS)
#include "render/shaders/shaded_air.glsl"
#endif
#ifdef CLOUDS
#include "render/shaders/cloudy_path.glsl"
#endif
#ifdef SEA
#include "render/shaders/sea_light.glsl"
#endif

layout(binding = 7) uniform usampler2D gbuffer;

const mat4 light_from_nodes = mat4(LIGHT_FROM_NODES);  // in the frame's primaries and luminance, cd/m^2

#ifdef SECOND_COLOR
// From the second sun's light to light of the first that looks the same (render/glsl/light_matrices.h).
const mat4 alike_nodes = mat4(SECOND_COLOR);
#endif

vec3 color_of(vec4 nodes) { return (light_from_nodes * nodes).rgb; }

#ifdef DISC
vec3 square_ray, square_across, square_along;  // of the pixel that seen_at() is asked for

#ifdef REFRACTION
// The direction in space of a ray to a sun's disc, by its bending: what the eye sees high stands lower.
vec3 before_refraction(vec3 ray, vec4 bending, vec4 range) {
  float across = length(ray.xy), zenith = atan(across, ray.z);
  float from_middle = clamp(zenith - bending.x, range.x, range.y);
  zenith += exp(bending.y + from_middle * (bending.z + from_middle * bending.w));
  return vec3(ray.xy * (sin(zenith) / max(across, 1e-6)), cos(zenith));
}
#endif

#ifdef MOON_RADIUS
#include "model/shared/moon.glsl"
// Of a direction, `inside` the moon's radius from its middle: x: radiance over the mean, y: 1 where the sun lights the moon.
vec2 moon_at(vec3 ray, float inside) {
  vec3 middle = suns[1].xyz, aside = ray - dot(ray, middle) * middle;
  float mu = sqrt(1.0 - inside * inside);
  vec3 normal = (inside / max(length(aside), 1e-9)) * aside - mu * middle;
  float mu_0 = dot(normal, suns[0].xyz), phase = acos(clamp(-dot(suns[0].xyz, middle), -1.0, 1.0));
  return vec2(moon_brightness(mu, mu_0, phase), step(0.0, mu_0));
}
#endif

// x: radiance of a disc over the mean, y: whether it shines; `inside` is the distance from the middle in radii.
vec2 disc_at(int sun, vec3 ray, float inside) {
#ifdef MOON_RADIUS
  if (sun == 1) return moon_at(ray, inside);
#endif
  return vec2(disc_brightness(inside), 1.0);
}

// A sun's disc with its limb darkening, whose mean over the disc is 1, as the mean over a square of the picture about a ray
// that is not normalised, with the square's sides. x: the disc, y: the share of the square that it covers. By points on
// rows and columns of 8, the edge softened over their distance.
vec2 disc(vec3 site_ray, vec3 across, vec3 along, int sun) {
  const int kSide = 8;
  float radius = disc_radius(sun);
  float softness = length(across) / (float(kSide) * length(site_ray));
  vec2 sum = vec2(0.0);
  for (int i = 0; i < kSide * kSide; ++i) {
    vec2 place = (vec2(i % kSide, i / kSide) + 0.5) / float(kSide) - 0.5;
    vec3 ray = normalize(site_ray + place.x * across + place.y * along);
#ifdef REFRACTION
    ray = before_refraction(ray, bending[2 * sun], bending[2 * sun + 1]);
#endif
    float away = 2.0 * asin(clamp(0.5 * length(ray - suns[sun].xyz), 0.0, 1.0));
    float cover = clamp((radius - away) / softness + 0.5, 0.0, 1.0);
    // Where the covered part has its mean; near the limb, which is steep.
    float inside = clamp((away - 0.3 * (1.0 - cover) * softness) / radius, 0.0, 1.0);
    sum += cover * disc_at(sun, ray, inside);
  }
  // An edge that rises evenly over the width w makes a disc larger by w^2 / (12 r^2).
  sum /= 1.0 + softness * softness / (12.0 * radius * radius);
  return sum / float(kSide * kSide);
}
#endif

struct PathLight {
  vec4 in_scatter, reflected, transmittance;
#ifdef LAYERS
  vec4 direct;  // the part of the reflected that is the sun's beam's
#endif
#ifdef DISC
  vec4 disc;  // part of the reflected
  float disc_cover;
#endif
};

PathLight no_light() {
  PathLight path;
  path.in_scatter = path.reflected = vec4(0.0);
  path.transmittance = vec4(1.0);
#ifdef LAYERS
  path.direct = vec4(0.0);
#endif
#ifdef DISC
  path.disc = vec4(0.0);
  path.disc_cover = 0.0;
#endif
  return path;
}

// What reaches the eye by the light of one sun.
#ifdef SURFACE
struct Surface {
  float d;  // from the eye
  vec3 normal, up;
  vec4 reflectance;
  bool water;
};

PathLight light_of(int i, ViewRay ray, Surface surface, MetClouds met) {
  vec3 sun = suns[i].xyz;
  float nu = clamp(dot(ray.direction, sun), -1.0, 1.0);
  Place start = place_of(ray, sun, nu);
  float in_air = max(surface.d - ray.entry, 0.0);
  Place end = place_along(start, nu, in_air);
  PathLight path = no_light();
#ifdef VOLUME
  VolumeLight light = volume_light(ray, in_air);
  path.in_scatter = radiance(light.scattering, nu);
  path.transmittance = light.transmittance;
#else
  if (ray.air && surface.d > ray.entry) {
#ifdef CLOSED_FORM
    path.transmittance = closed_form_through(start, end.h, in_air);
    path.in_scatter = closed_form_inscatter(start, nu, end.h, in_air);
#else
    // Both ends from the same table: nothing is left of its errors where they are near each other.
    path.transmittance = transmittance_between(start, end, ray.hits_ground);
#ifdef HILLAIRE
    path.in_scatter = radiance(hillaire_march(start, nu, in_air), nu);
#elif defined(BODARE)
    path.in_scatter = radiance(bodare_march(start, nu, in_air, ray.hits_ground), nu);
#elif defined(ONEIL)
    path.in_scatter = radiance(oneil_sum(start, nu, in_air), nu);
#else
    WholeRay whole = whole_ray(ray, start, sun, nu, i);
#ifdef BRUNETON_BY_RADII
    Scattering rest = sky_ray_scattering(end, nu);
#else
    Scattering rest = scattering(end, nu, ray.hits_ground);
#endif
    path.in_scatter = radiance(scattering_before(whole.scattering, path.transmittance, rest), nu);
#endif
#endif
  }
#endif
  float lit = 1.0;
#ifdef SHADOWS
  lit *= sunlit(surface.d * ray.direction, surface.normal, i);
#endif
#ifdef CLOUDS
  lit *= clear_of_clouds(surface.d * ray.direction, end, sun, kNoCloud, surface.d * pixel_angle);
#endif
#ifdef VOLUME
  Place at = end;
#else
  Place at = Place(height_after(bottom_km, camera_km, ray.direction.z, surface.d), end.mu, dot(surface.up, sun));
#endif
  vec4 reflected = (kInversePi * surface.reflectance) * surface_irradiance(at, surface.normal, surface.up, sun, lit);
#ifdef SEA
  if (surface.water) reflected += sea_radiance(at, surface.d * ray.direction, surface.up, i, lit);
#endif
  path.reflected = met.clear * path.transmittance * reflected;
#ifdef LAYERS
  path.direct = (kInversePi * surface.reflectance) * direct_irradiance(at, surface.normal, sun, lit);
#ifdef SEA
  if (surface.water) path.direct += sea_glitter_radiance(at, -ray.direction, surface.up, sun, lit);
#endif
  path.direct *= met.clear * path.transmittance;
#endif
#else
PathLight light_of(int i, ViewRay ray, MetClouds met) {
  vec3 sun = suns[i].xyz;
  float nu = clamp(dot(ray.direction, sun), -1.0, 1.0);
  Place start = place_of(ray, sun, nu);
  PathLight path = no_light();
  if (ray.air) {
#ifdef CLOSED_FORM
    path.transmittance = closed_form_to_sky(start.h, start.mu);
    path.in_scatter = closed_form_sky(start, nu);
#else
    WholeRay whole = whole_ray(ray, start, sun, nu, i);
    path.in_scatter = radiance(whole.scattering, nu);
    path.transmittance = exp(-whole.depth);
#endif
  }
#ifdef DISC
  vec2 disc_and_cover = disc(square_ray, square_across, square_along, i);
  path.disc = suns[i].w * met.clear * path.transmittance * (disc_and_cover.x / disc_solid_angle(i));
  path.disc_cover = disc_and_cover.y;
#endif
#endif
#ifndef SURFACE
  const float in_air = kInfinity;
#endif
#ifdef SHADOWS
  if (ray.air) path.in_scatter = without_shaded(path.in_scatter, light_under_terrain(ray, start, nu, in_air, i));
#endif
#ifdef CLOUDS
  if (ray.air) path.reflected += among_clouds(path.in_scatter, ray, start, nu, in_air, met, pixel_angle, i, kCloudShadowSteps);
#endif
  path.in_scatter *= suns[i].w;
  path.reflected *= suns[i].w;
#ifdef DISC
  path.reflected += path.disc;
#endif
#ifdef LAYERS
  path.direct *= suns[i].w;
#ifdef DISC
  path.direct += path.disc;
#endif
#endif
  return path;
}

struct Seen {
  vec4 light;  // in the frame's primaries and luminance, cd/m^2
  float distance_km;
#ifdef DISC
  vec4 disc;  // the suns' part of the light's colour; the share of the pixel that they cover
#endif
#ifdef LAYERS
  // A frame has eight colour targets at most: the alphas of the first three hold the direct light's red, green and blue.
  vec4 in_scatter, reflected, transmittance, albedo, normal;
#endif
};

// The rays are those of ray_through(), in the camera frame and in the planet's axes.
Seen seen_at(ivec2 pixel, vec3 site_ray, vec3 planet_ray) {
#ifdef SHADOWS
  pixel_centre = vec2(pixel) + 0.5;
#endif
#ifdef DISC
  // Not interpolated between the corners of the disc's square: where it is cut off at the picture's edge, slivers of it
  // have no derivatives.
  vec2 samples = vec2(textureSize(gbuffer, 0));
  site_ray = ray_through(2.0 * (vec2(pixel) + 0.5) / samples - 1.0);
  planet_ray = planet_from_site * site_ray;
  square_ray = site_ray;
  square_across = site_from_view * vec3(2.0 * tangent.x / samples.x, 0.0, 0.0);
  square_along = site_from_view * vec3(0.0, 2.0 * tangent.y / samples.y, 0.0);
#endif
  float stretch = length(site_ray);
  vec3 direction = site_ray * (1.0 / stretch);
#ifdef SURFACE
  Surface surface;
  GroundSample ground = unpack_ground(texelFetch(gbuffer, pixel, 0));
  float along_axis = near_km / ground.depth;
  surface.d = along_axis * stretch;
  ViewRay ray = view_ray(straight_ray(direction, surface.d));
#ifdef REFRACTION
  planet_ray = stretch * (planet_from_site * ray.direction);
#endif
  surface.water = ground.rock < WATER_LIMIT;
  surface.normal = ground.normal;
  surface.reflectance = min(with_material(along_axis * planet_ray, surface.d, planet_ray * (1.0 / stretch), ground.rock,
                                          ground.reflectance, surface.normal), 1.0);
  surface.normal = surface.normal * planet_from_site;  // by the transpose: into the camera frame
  surface.up = normalize(vec3(0.0, 0.0, bottom_km + camera_km) + surface.d * ray.direction);
  if (surface.water) surface.normal = surface.up;  // level, whatever the land beside it in the same triangle
  if (ray.hits_ground) surface.d = min(surface.d, ray.entry + ray.to_ground);
  float d = surface.d;
#else
  ViewRay ray = view_ray(straight_ray(direction));
  // A ray that misses the triangles but not the sphere grazes it.
  ray.hits_ground = false;
  const float d = kInfinity;
#endif
#ifdef CLOUDS
  MetClouds met = meet_clouds(ray, d, pixel_angle);
#else
  const MetClouds met = MetClouds(1.0);
#endif
#ifdef SURFACE
  PathLight path = light_of(0, ray, surface, met);
#else
  PathLight path = light_of(0, ray, met);
#endif
#ifdef SECOND_SUN
  // Not a loop, which the software renderer does not unroll.
#ifdef SURFACE
  PathLight other = light_of(1, ray, surface, met);
#else
  PathLight other = light_of(1, ray, met);
#endif
#ifdef SECOND_COLOR
  other.in_scatter = alike_nodes * other.in_scatter;
  other.reflected = alike_nodes * other.reflected;
#ifdef LAYERS
  other.direct = alike_nodes * other.direct;
#endif
#ifdef DISC
  other.disc = alike_nodes * other.disc;
#endif
#endif
  path.in_scatter += other.in_scatter;
  path.reflected += other.reflected;
#ifdef LAYERS
  path.direct += other.direct;
#endif
#ifdef DISC
  path.disc += other.disc;
  path.disc_cover = min(path.disc_cover + other.disc_cover, 1.0);
#endif
#endif
  Seen seen;
  seen.light = light_from_nodes * (path.in_scatter + path.reflected);
  seen.distance_km = d;
#ifdef DISC
  seen.disc = vec4(color_of(path.disc), path.disc_cover);
#endif
#ifdef LAYERS
  vec3 white = color_of(vec4(1.0)), direct = color_of(path.direct);
  seen.in_scatter = vec4(color_of(path.in_scatter), direct.r);
  seen.reflected = vec4(color_of(path.reflected), direct.g);
  seen.transmittance = vec4(color_of(met.clear * path.transmittance) / white, direct.b);
#ifdef SURFACE
  seen.albedo = vec4(color_of(surface.reflectance) / white, 1.0);
  seen.normal = vec4(surface.normal, 1.0);
#else
  seen.albedo = vec4(0.0);
  seen.normal = vec4(0.0);
#endif
#endif
  return seen;
}
