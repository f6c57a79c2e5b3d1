// SPDX-License-Identifier: Apache-2.0
// Sheets of clouds, CLOUDS of them: each at one height, without thickness; it dims what lies behind it and scatters like a
// rough white surface seen from both sides. No scattering inside, one crossing of a ray with each sheet.
#include "render/shaders/view_ray.glsl"
#include "render/shaders/surface_light.glsl"
#include "render/shaders/cloud_octaves.glsl"

layout(binding = 14) uniform sampler3D cloud_noise;  // mean 1/2, deviation kCloudDeviation

layout(std140, binding = 4) uniform Clouds {
  // In the order in which rays from the eye meet them: height, km; opacity of the densest; noise in the middle of their edge,
  // for the cover.
  vec4 cloud_sheets[CLOUDS];
};

// A turn about (1, 2, 3) by 1.1 rad: the lattices of the octaves do not line up with one another.
const mat3 kCloudTurn = mat3(0.492624970, 0.792613254, -0.359283826, -0.636497861, 0.609711515, 0.472358277, 0.593456917, -0.004012095, 0.804855758);

// Periods of the noise between sheets a kilometre apart: clouds do not lie straight above others of the same form.
const vec3 kSheetShift = vec3(0.61, 0.37, 0.23);

// At a point above or below a sheet, relative to the planet's centre, seen along the vertical: the mean over about `width_km`.
// Every octave bends the smaller ones along an axis of its own, so that clouds are drawn out and the noise, which repeats, does
// not show it.
float cloud_opacity_at(vec4 sheet, vec3 from_centre, float width_km) {
  const float kBend = 0.2, kEdge = 0.07;
  vec3 place = planet_from_site * normalize(from_centre) * bottom_km;
  float weight = (kCloudGain - 1.0) / (pow(kCloudGain, float(kCloudOctaves)) - 1.0);  // the sum is 1
  float period = kLongestCloud_km, noise = 0.0, averaged = 0.0;
  for (int i = 0; i < kCloudOctaves; ++i) {
    float level = log2(max(64.0 * width_km / period, 1.0));
    float own = 0.5;
    float kept = clamp(1.0 - 0.25 * level, 0.0, 1.0);  // of its deviation; the fifth mipmap is flat
    if (kept > 0.0) own = textureLod(cloud_noise, place / period + vec3(0.37 * float(i)) + sheet.x * kSheetShift, level).x;
    noise += weight * own;
    averaged += weight * weight * (1.0 - kept * kept);
    place = kCloudTurn * (place + vec3(kBend * period * (own - 0.5), 0.0, 0.0));
    period /= kCloudRatio;
    weight *= kCloudGain;
  }
  // The mean of the clouds' edge, as wide as kEdge, over what of the noise was averaged: variances add, and a smoothstep is
  // the integral of a density whose variance is a 20th of its width squared.
  float reach = 0.5 * sqrt(kEdge * kEdge + 20.0 * kCloudDeviation * kCloudDeviation * averaged);
  return sheet.y * smoothstep(sheet.z - reach, sheet.z + reach, noise);
}

// Of a sheet that a ray crosses at a slant.
float slanted(float opacity, float cosine) { return 1.0 - pow(max(1.0 - opacity, 0.0), 1.0 / max(abs(cosine), 0.1)); }

// To where a ray meets a sheet first; infinite where it does not.
float cloud_distance(float cloud_km, ViewRay ray) {
  float impact = (bottom_km + ray.h) * sqrt(max(1.0 - ray.mu * ray.mu, 0.0));
  bool below = ray.h < cloud_km;
  bool meets = ray.air && (below ? !ray.hits_ground : ray.mu < 0.0 && impact < bottom_km + cloud_km);
  float d = below ? distance_to_outer_sphere(bottom_km, ray.h, ray.mu, cloud_km)
                  : distance_to_inner_sphere(bottom_km, ray.h, ray.mu, cloud_km);
  return meets ? ray.entry + d : kInfinity;
}

// How a ray meets the sheets: where, km from its eye; how much each takes; what all of them let pass.
struct MetClouds {
  float distances[CLOUDS], opacities[CLOUDS];
  float clear;
};

// Up to the distance `end`; clouds are seen as their mean over the angle `spread`.
MetClouds meet_clouds(ViewRay ray, float end, float spread) {
  MetClouds met;
  met.clear = 1.0;
  for (int i = 0; i < CLOUDS; ++i) {
    float d = cloud_distance(cloud_sheets[i].x, ray);
    float opacity = 0.0;
    if (!isinf(d) && d < end) {
      vec3 from_centre = vec3(0.0, 0.0, bottom_km + camera_km) + ray.eye + d * ray.direction;
      opacity = slanted(cloud_opacity_at(cloud_sheets[i], from_centre, d * spread), dot(normalize(from_centre), ray.direction));
    }
    met.distances[i] = d;
    met.opacities[i] = opacity;
    met.clear *= 1.0 - opacity;
  }
  return met;
}

// Share of a sun's beam that gets through the sheets on its way to a place, as the mean over about `width_km`; `position` is
// relative to the camera. Of a place in a sheet, `own`, that sheet does not count.
float clear_of_clouds(vec3 position, Place at, vec3 sun, int own, float width_km) {
  float clear = 1.0;
  for (int i = 0; i < CLOUDS; ++i) {
    if (i == own || at.h >= cloud_sheets[i].x || at.mu_s <= 0.0) continue;
    float d = distance_to_outer_sphere(bottom_km, at.h, at.mu_s, cloud_sheets[i].x);
    vec3 from_centre = vec3(0.0, 0.0, bottom_km + camera_km) + position + d * sun;
    clear *= 1.0 - slanted(cloud_opacity_at(cloud_sheets[i], from_centre, width_km), dot(normalize(from_centre), sun));
  }
  return clear;
}
const int kNoCloud = -1;

// Two thirds of the light come back from the side that it falls on, the rest passes; of a beam along the sheet half each. The
// roughness keeps a low sun's beam from vanishing.
// `lit`: share of the beam that other sheets let through.
vec4 cloud_radiance(float cloud_km, Place at, float eye_h, float lit) {
  bool from_above = eye_h > cloud_km;
  vec4 beam = lit * sun_transmittance(at.h, at.mu_s);
  vec4 sky = sky_irradiance(at.h, at.mu_s);
  vec4 direct = beam * ((abs(at.mu_s) + 0.2) / 1.2);
  vec4 ground = ground_albedo * (beam * max(at.mu_s, 0.0) + sky);
  float sunny_side = mix(0.31, 0.62, smoothstep(-0.1, 0.1, from_above ? at.mu_s : -at.mu_s));
  float sky_side = from_above ? 0.62 : 0.31;
  return (sunny_side * direct + sky_side * sky + (0.93 - sky_side) * ground) / kPi;
}
