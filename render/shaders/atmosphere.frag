// SPDX-License-Identifier: Apache-2.0
// The atmosphere as one pass over the G-buffer: light reflected by the ground, dimmed on the way, plus the light that the
// air scatters into the path (Sperlhofer 2011, 4.6.2), or sky and sun where there is no ground.
#include "render/shaders/atmosphere.glsl"

layout(binding = 5) uniform sampler2D color;
layout(binding = 6) uniform sampler2D normal_reflectance;
layout(binding = 7) uniform sampler2D depth;

uniform mat3 site_from_view;
uniform vec2 tangent;
uniform float near_km;
uniform float camera_km;       // height of the camera
uniform vec3 sun;              // unit vector, z up at the camera
uniform float pixel_angle;     // rad
uniform vec4 ground_albedo;
uniform mat4x3 xyz_from_nodes;
uniform mat3 srgb_from_xyz;

in vec2 screen;
layout(location = 0) out vec4 light;      // linear sRGB and luminance, cd/m^2
layout(location = 1) out float distance_km;

const float kInfinity = uintBitsToFloat(0x7f800000u);

// The sun's disc with the limb darkening 1 - 0.6 (1 - cos), its edge softened over a pixel.
vec4 sun_disc(vec3 ray, Place eye) {
  float away = 2.0 * asin(clamp(0.5 * length(ray - sun), 0.0, 1.0));
  float cover = clamp((kSunRadius - away) / pixel_angle + 0.5, 0.0, 1.0);
  if (cover <= 0.0) return vec4(0.0);
  float inside = min(away / kSunRadius, 1.0);
  float darkening = (1.0 - 0.6 * (1.0 - sqrt(1.0 - inside * inside))) / 0.8;
  return exp(-optical_depth_to_top(eye.h, eye.mu)) * (cover * darkening / kSunSolidAngle);
}

// Sun, sky above a tilted surface and the ground around it.
vec4 ground_radiance(vec4 reflectance, vec3 normal, vec3 up, Place at) {
  vec4 beam = sun_transmittance(at.h, at.mu_s);
  vec4 sky = sky_irradiance(at.h, at.mu_s);
  float facing = dot(normal, up);
  vec4 around = ground_albedo * (beam * max(at.mu_s, 0.0) + sky);
  vec4 irradiance = beam * max(dot(normal, sun), 0.0) + sky * (0.5 + 0.5 * facing) + around * (0.5 - 0.5 * facing);
  return reflectance / kPi * irradiance;
}

void main() {
  vec3 view = vec3(screen * tangent, -1.0);
  float stretch = length(view);
  vec3 ray = site_from_view * (view / stretch);
  float z = texelFetch(depth, ivec2(gl_FragCoord.xy), 0).x;
  float d = z > 0.0 ? near_km / z * stretch : kInfinity;
  float r0 = bottom_km + camera_km;
  float nu = clamp(dot(ray, sun), -1.0, 1.0);

  // Outside the atmosphere the path starts at its top; the impact parameter keeps the digits that mu would lose.
  float impact = r0 * length(ray.xy);
  float entry = 0.0;
  Place start = Place(camera_km, ray.z, sun.z);
  bool air = true;
  if (camera_km > thickness_km) {
    float top = bottom_km + thickness_km;
    air = ray.z < 0.0 && impact < top;
    float half_chord = sqrt(max((top - impact) * (top + impact), 0.0));
    entry = -r0 * ray.z - half_chord;
    start = Place(thickness_km, -half_chord / top, clamp((r0 * sun.z + entry * nu) / top, -1.0, 1.0));
  }
  bool hits_ground = ray.z < 0.0 && impact < bottom_km;
  vec4 nodes = vec4(0.0);
  if (air) {
    if (hits_ground) d = min(d, entry + distance_to_inner_sphere(bottom_km, start.h, start.mu, 0.0));
    nodes = radiance(scattering(start, nu, hits_ground), nu);
  }
  if (d < kInfinity) {
    Place end = air ? place_along(start, nu, max(d - entry, 0.0)) : start;
    vec4 through = transmittance_between(start, end, hits_ground);
    vec4 beyond = radiance(scattering(end, nu, hits_ground), nu);
    vec3 up = normalize(vec3(0.0, 0.0, r0) + d * ray);
    vec4 reflectance = ground_albedo;
    vec3 normal = up;
    if (z > 0.0) {
      vec4 shape = texelFetch(normal_reflectance, ivec2(gl_FragCoord.xy), 0);
      reflectance = texelFetch(color, ivec2(gl_FragCoord.xy), 0) * (shape.w * kPi);
      normal = normalize(shape.xyz);
    }
    nodes = max(nodes - through * beyond, 0.0) + through * ground_radiance(reflectance, normal, up, end);
  } else {
    nodes += air ? sun_disc(ray, start) : vec4(0.0);
  }
  vec3 xyz = xyz_from_nodes * nodes;
  light = vec4(srgb_from_xyz * xyz, xyz.y);
  distance_km = d;
}
