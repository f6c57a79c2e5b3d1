// SPDX-License-Identifier: Apache-2.0
// The atmosphere's tables as functions. Lengths in kilometres, values at the four wavelengths of the colour rule, per
// unit solar irradiance. A point is its height above the bottom radius; see model/tables/tables.h for what each table holds.
// What stays the same for a renderer's life is defined, which saves the software renderer much of its time (it loads a uniform
// anew at each use): see atmosphere_defines(), render/gl/atmosphere/atmosphere_pass.h.
#include "render/shaders/constants.glsl"
#include "render/shaders/pi.glsl"
#include "model/shared/geometry.glsl"
#include "model/shared/phase.glsl"
#include "model/shared/mapping.glsl"

TABLE(0, sampler2D, optical_depth_table)
TABLE(1, sampler2D, irradiance_table)
TABLE(2, sampler3D, rayleigh_like_table)
TABLE(3, sampler3D, single_table)  // the classes of phase functions one after the other along z
TABLE(4, sampler2D, phase_table)   // logarithm of tabulated phase functions, a class in a row

#ifdef CHANGES
// What other values of parameters add to the logarithms of all these, by the same mappings in fewer texels: see
// render/page/changes.h. CHANGE_SIZE and CHANGE_HEIGHTS are as SCATTERING_SIZE and SCATTERING_HEIGHTS.
uniform sampler2D optical_depth_change;
uniform sampler2D irradiance_change;
uniform sampler3D rayleigh_like_change;
uniform sampler3D single_change;
uniform sampler2D phase_change;
const vec4 change_size = vec4(CHANGE_SIZE);
const float change_heights = float(CHANGE_HEIGHTS);
#endif

const int kClasses = CLASSES;  // of phase functions but the Rayleigh-like one, model/tables/phase_classes.h

// Of closed forms: the scattering coefficients of air and aerosol at density 1, 1/m; by Nielsen the asymmetry of thick haze
// and the factor on the Mie coefficient; by the others the scale heights; of formulas over the turbidity the turbidity and the
// radiances per cd/m^2 of X, Y and Z.
#if defined(NIELSEN)
#define CLOSED_FORM_CONSTANTS(EACH) EACH(vec4, air_beta) EACH(vec4, aerosol_beta) EACH(vec2, nielsen_haze)
#elif defined(FORMULA_SKY)
#define CLOSED_FORM_CONSTANTS(EACH)                                         \
  EACH(vec4, air_beta) EACH(vec4, aerosol_beta) EACH(vec2, scale_heights_m) \
  EACH(vec4[3], radiance_from_xyz) EACH(float, turbidity)
#elif defined(CLOSED_FORM)
#define CLOSED_FORM_CONSTANTS(EACH) EACH(vec4, air_beta) EACH(vec4, aerosol_beta) EACH(vec2, scale_heights_m)
#else
#define CLOSED_FORM_CONSTANTS(EACH)
#endif

// What the texels of the scattering tables stand for where they are ENCODED (model/tables/table_precision.h): texel_scale times
// the texel plus texel_offset; of rayleigh_like_table, of single_table, and of the two of sky_rays.glsl.
#ifdef ENCODED
#define ENCODING_CONSTANTS(EACH) EACH(vec4, texel_scale) EACH(vec4, texel_offset)
#else
#define ENCODING_CONSTANTS(EACH)
#endif

// The Rayleigh-like class's depolarisation; g, g1, g2 and weight of phase functions that are not tabulated (of another
// Rayleigh phase function its depolarisation).
#define ATMOSPHERE_CONSTANTS(EACH)         \
  EACH(float, depolarisation)              \
  EACH(vec4[CLASSES], phase_parameters)    \
  EACH(vec4, ground_albedo)                \
  ENCODING_CONSTANTS(EACH)                 \
  CLOSED_FORM_CONSTANTS(EACH)
#ifdef LIBRARY  // for other people's renderers: of one atmosphere, without uniforms
const float depolarisation = float(DEPOLARISATION);
const vec4 phase_parameters[CLASSES] = LIST(vec4, CLASSES, PHASE_PARAMETERS);
const vec4 ground_albedo = vec4(GROUND_ALBEDO);
#ifdef ENCODED
const vec4 texel_scale = vec4(TEXEL_SCALE);
const vec4 texel_offset = vec4(TEXEL_OFFSET);
#endif
#else
CONSTANTS(0, Atmosphere, ATMOSPHERE_CONSTANTS)
#endif

const int kPhaseTypes[CLASSES] = LIST(int, CLASSES, PHASE_TYPES);  // PhaseType of model/atmosphere/constituent.h
const int kLobeTypes[CLASSES] = LIST(int, CLASSES, LOBE_TYPES);

const float bottom_km = float(BOTTOM_KM);
const float thickness_km = float(THICKNESS_KM);
const vec2 optical_depth_size = vec2(OPTICAL_DEPTH_SIZE);
const vec2 irradiance_size = vec2(IRRADIANCE_SIZE);
const vec4 scattering_size = vec4(SCATTERING_SIZE);  // mu_s, azimuth, rays to the ground, rays to the sky
const float scattering_heights = float(SCATTERING_HEIGHTS);
#ifdef HEIGHT_UNITS
const float kHeightNodes[HEIGHT_NODES] = LIST(float, HEIGHT_NODES, HEIGHT_UNITS);
float height_node(int i) { return kHeightNodes[i]; }
#elif defined(HEIGHT_NODES)  // too many for the constants above
layout(std140, binding = 7) uniform TableHeights { vec4 height_nodes[(HEIGHT_NODES + 3) / 4]; };
float height_node(int i) { return height_nodes[i >> 2][i & 3]; }
#endif

// The star's disc: its radius (rad), its solid angle (sr), its limb darkening 1 - u1 (1 - mu) - u2 (1 - mu)^2.
const float kSunRadius = SUN_RADIUS;
const float kSunSolidAngle = SUN_SOLID_ANGLE;
const vec2 kLimbDarkening = vec2(LIMB_DARKENING);

// Of the disc at a distance from its centre in its radii, over its mean.
float disc_brightness(float distance) {
  float fall = 1.0 - sqrt(1.0 - distance * distance);  // 1 - mu
  return (1.0 - dot(kLimbDarkening, vec2(fall, fall * fall))) / (1.0 - dot(kLimbDarkening, vec2(1.0 / 3.0, 1.0 / 6.0)));
}

#ifdef EXACT_FILTER
// GPUs interpolate in steps of 1/256 of a texel, too coarse where neighbouring points are subtracted; others round the result.
vec4 look_up(sampler2D table, vec2 at) {
  ivec2 size = textureSize(table, 0);
  vec2 place = clamp(at * vec2(size) - 0.5, vec2(0.0), vec2(size) - 1.0);
  ivec2 low = min(ivec2(place), size - 2);
  vec2 t = place - vec2(low);
  return mix(mix(texelFetch(table, low, 0), texelFetch(table, low + ivec2(1, 0), 0), t.x),
             mix(texelFetch(table, low + ivec2(0, 1), 0), texelFetch(table, low + 1, 0), t.x), t.y);
}
vec4 slice_of(sampler3D table, ivec3 low, vec2 t) {
  return mix(mix(texelFetch(table, low, 0), texelFetch(table, low + ivec3(1, 0, 0), 0), t.x),
             mix(texelFetch(table, low + ivec3(0, 1, 0), 0), texelFetch(table, low + ivec3(1, 1, 0), 0), t.x), t.y);
}
vec4 look_up(sampler3D table, vec3 at) {
  ivec3 size = textureSize(table, 0);
  vec3 place = clamp(at * vec3(size) - 0.5, vec3(0.0), vec3(size) - 1.0);
  ivec3 low = min(ivec3(place), size - 2);
  vec3 t = place - vec3(low);
  return mix(slice_of(table, low, t.xy), slice_of(table, low + ivec3(0, 0, 1), t.xy), t.z);
}
#else
vec4 look_up(sampler2D table, vec2 at) { return texture(table, at); }
vec4 look_up(sampler3D table, vec3 at) { return texture(table, at); }
#endif

// The same at all wavelengths.
vec4 grey(float x) { return vec4(x, x, x, x); }

// Of a class, counted from 0 behind the Rayleigh-like one.
vec4 class_phase(int c, float nu) {
  vec4 p = phase_parameters[c];
  if (kPhaseTypes[c] == 2) return grey(two_lobe_phase(kLobeTypes[c], p.y, p.z, p.w, nu));
  if (kPhaseTypes[c] == 3 || kPhaseTypes[c] == 5 || kPhaseTypes[c] == 6) {
    float angle = acos(clamp(nu, -1.0, 1.0)) * kInversePi, v = (float(c) + 0.5) / float(kClasses);
    float u = texture_from_unit(angle, float(textureSize(phase_table, 0).x));
    vec4 logarithm = texture(phase_table, vec2(u, v));
#ifdef CHANGES
    logarithm += texture(phase_change, vec2(texture_from_unit(angle, float(textureSize(phase_change, 0).x)), v));
#endif
    return exp(logarithm);
  }
  if (kPhaseTypes[c] == 4) return grey(rayleigh_phase(p.x, nu));
  return grey(lobe_phase(kPhaseTypes[c], p.x, nu));
}

// A point on the view ray, as the tables see it.
struct Place {
  float h, mu, mu_s;
};

// A function, because HLSL has no constructors of structures.
Place place_at(float h, float mu, float mu_s) {
  Place place;
  place.h = h;
  place.mu = mu;
  place.mu_s = mu_s;
  return place;
}

#if defined(CLOSED_FORM) || defined(ONEIL)  // once: a file is included where it is named first
#include "model/shared/closed_forms.glsl"
#endif
#ifdef CLOSED_FORM
#include "render/shaders/closed_form.glsl"
#endif

// Height of the deck (model/shared/mapping.glsl).
float deck_km() {
#ifdef HEIGHT_NODES
  return height_from_unit(height_node(DECK_NODE), thickness_km);
#else
  return -1.0;
#endif
}

// docs/theory (9.13).
// Coordinate 0..1 of a height: where layers are, by the heights that HeightAxis (model/tables/height_axis.h) chose.
float unit_from_table_height(float h) {
  float unit = unit_from_height(h, thickness_km);
#ifdef HEIGHT_NODES
  int below = 0, above = HEIGHT_NODES - 1;
  while (above - below > 1) {
    int middle = (below + above) / 2;
    if (unit < height_node(middle)) above = middle;
    else below = middle;
  }
  float low = height_node(below);
  unit = (float(below) + (unit - low) / (height_node(above) - low)) / float(HEIGHT_NODES - 1);
#endif
  return unit;
}

float height_coordinate(float h, float size) { return texture_from_unit(unit_from_table_height(h), size); }

// Of two coordinates 0..1, where the second is that of a height.
vec2 place_in_table(float unit, float h, vec2 size) {
  return vec2(texture_from_unit(unit, size.x), height_coordinate(h, size.y));
}

#ifdef CHANGES
// Their heights do not follow layers.
float height_in_changes(float h, float size) { return texture_from_unit(unit_from_height(h, thickness_km), size); }

vec2 place_in_changes(float unit, float h, vec2 size) {
  return vec2(texture_from_unit(unit, size.x), height_in_changes(h, size.y));
}
#endif

// From the point to the top, for rays that miss the ground.
vec4 optical_depth_to_top(float h, float mu) {
  float unit = unit_from_upward_ray(h, mu, bottom_km, thickness_km);
  vec4 depth = look_up(optical_depth_table, place_in_table(unit, h, optical_depth_size));
#ifdef LEAST_TRANSMITTANCE
  // The table holds transmittances.
  depth = -log(max(depth, grey(LEAST_TRANSMITTANCE)));
#endif
#ifdef CHANGES
  depth *= exp(look_up(optical_depth_change, place_in_changes(unit, h, vec2(textureSize(optical_depth_change, 0)))));
#endif
  return depth;
}

// The same by the ray's lowest point: of rays that pass near the ground from high above, the table has few.
vec4 optical_depth_past_ground(float h, float mu) {
  if (mu >= 0.0) return optical_depth_to_top(h, mu);
  float lowest = max(height_after(bottom_km, h, mu, -(bottom_km + h) * mu), 0.0);
  return max(2.0 * optical_depth_to_top(lowest, 0.0) - optical_depth_to_top(h, -mu), 0.0);
}

// Of the sun's beam; the disc sinks behind the horizon over its diameter.
vec4 sun_transmittance(float h, float mu_s) {
  float sin_horizon = bottom_km / (bottom_km + h);
  float mu_horizon = -sqrt(max(1.0 - sin_horizon * sin_horizon, 0.0));
  float half_disc = sin_horizon * kSunRadius;
  float visible = smoothstep(-half_disc, half_disc, mu_s - mu_horizon);
  if (visible <= 0.0) return grey(0.0);
#ifdef CLOSED_FORM
  return visible * closed_form_sun(h, mu_s);
#else
  return visible * exp(-optical_depth_to_top(h, max(mu_s, mu_horizon)));
#endif
}

// Below the lowest sun of the tables the twilight falls by e per degree of the sun's height.
float deep_twilight(float sun) { return exp(min((sun - LOWEST_SUN) * 57.3, 0.0)); }

// Diffuse, on a horizontal surface that faces up.
vec4 sky_irradiance(float h, float mu_s) {
  float sun = sun_height(h, mu_s, bottom_km);
  float unit = unit_from_sun(sun, LOWEST_SUN);
  vec4 irradiance = look_up(irradiance_table, place_in_table(unit, h, irradiance_size));
#ifdef CHANGES
  irradiance *= exp(look_up(irradiance_change, place_in_changes(unit, h, vec2(textureSize(irradiance_change, 0)))));
#endif
  return deep_twilight(sun) * irradiance;
}

Place place_along(Place from, float nu, float d) {
  float h = max(height_after(bottom_km, from.h, from.mu, d), 0.0);
  float r = bottom_km + h;
  float r0 = bottom_km + from.h;
  return place_at(min(h, thickness_km), clamp((r0 * from.mu + d) / r, -1.0, 1.0),
                  clamp((r0 * from.mu_s + d * nu) / r, -1.0, 1.0));
}

// Without the phase functions of those that scattered last.
struct Scattering {
  vec4 rayleigh_like;
  vec4 single[CLASSES];
};

Scattering scaled(Scattering s, vec4 factor) {
  s.rayleigh_like *= factor;
  for (int c = 0; c < kClasses; ++c) s.single[c] *= factor;
  return s;
}
Scattering scaled(Scattering s, float factor) { return scaled(s, grey(factor)); }

// Of a logarithm. 0 below the least float, where some drivers stop.
vec4 light_from_logarithm(vec4 logarithm) { return step(grey(-87.0), logarithm) * exp(logarithm); }

// Of logarithms.
Scattering exponential(Scattering s) {
  s.rayleigh_like = light_from_logarithm(s.rayleigh_like);
  for (int c = 0; c < kClasses; ++c) s.single[c] = light_from_logarithm(s.single[c]);
  return s;
}

Scattering between(Scattering a, Scattering b, float share) {
  a.rayleigh_like = mix(a.rayleigh_like, b.rayleigh_like, share);
  for (int c = 0; c < kClasses; ++c) a.single[c] = mix(a.single[c], b.single[c], share);
  return a;
}

// The place of a class in a texture that holds them one after the other along an axis.
float in_class(int c, float at) { return (float(c) + at) / float(kClasses); }

Scattering look_up_classes(sampler3D rayleigh_like, sampler3D single, vec3 at) {
  Scattering s;
  s.rayleigh_like = look_up(rayleigh_like, at);
  for (int c = 0; c < kClasses; ++c) s.single[c] = look_up(single, vec3(at.xy, in_class(c, at.z)));
  return s;
}

#ifdef ENCODED
Scattering decoded(Scattering texels, vec2 scale, vec2 offset) {
  texels.rayleigh_like = texels.rayleigh_like * scale.x + offset.x;
  for (int c = 0; c < kClasses; ++c) texels.single[c] = texels.single[c] * scale.y + offset.y;
  return texels;
}
#endif

// A whole ray as the tables see it: coordinates of azimuth and sun, 0..1, and the factor of the mean that they hold.
struct TableRay {
  float azimuth, sun, light;
};

TableRay table_ray(Place from, float nu, bool hits_ground) {
  Place at = place_along(from, nu, distance_to_sun_point(from.h, from.mu, hits_ground, bottom_km, thickness_km));
  float sun = sun_height(at.h, at.mu_s, bottom_km);
  float length_km = hits_ground ? distance_to_inner_sphere(bottom_km, from.h, from.mu, 0.0)
                                : distance_to_outer_sphere(bottom_km, from.h, from.mu, thickness_km);
  TableRay ray;
  ray.azimuth = unit_from_azimuth(cosine_of_azimuth(at.mu, at.mu_s, nu));
  ray.sun = unit_from_sun(sun, LOWEST_SUN);
  ray.light = length_km * deep_twilight(sun);
  return ray;
}

// What two tables of such texels, as scattering_size is, hold of a whole ray; `height` is the texture coordinate.
Scattering ray_texels(sampler3D rayleigh_like, sampler3D single, vec4 size, float height, float deck, Place from,
                      bool hits_ground, TableRay ray) {
  float turn = ray.azimuth * (size.y - 1.0);
  float first = min(floor(turn), size.y - 2.0);
  float u_sun = texture_from_unit(ray.sun, size.x);
  vec3 left = vec3((first + u_sun) / size.y,
                   texture_from_view(from.h, from.mu, hits_ground, size.z, size.w, bottom_km, thickness_km,
                                     deck),
                   height);
  vec3 right = left + vec3(1.0 / size.y, 0.0, 0.0);
  return between(look_up_classes(rayleigh_like, single, left), look_up_classes(rayleigh_like, single, right),
                 turn - first);
}

// Along the whole ray from a place, to the top or to the ground.
Scattering scattering(Place from, float nu, bool hits_ground) {
  TableRay ray = table_ray(from, nu, hits_ground);
  Scattering means = ray_texels(rayleigh_like_table, single_table, scattering_size,
                                height_coordinate(from.h, scattering_heights), deck_km(), from, hits_ground, ray);
#ifdef ENCODED
  means = decoded(means, texel_scale.xy, texel_offset.xy);
#endif
#ifdef CHANGES
  Scattering change = ray_texels(rayleigh_like_change, single_change, change_size,
                                 height_in_changes(from.h, change_heights), -1.0, from, hits_ground, ray);
  means.rayleigh_like += change.rayleigh_like;
  for (int c = 0; c < kClasses; ++c) means.single[c] += change.single[c];
#endif
  // The tables hold logarithms of the mean over the ray.
  return scaled(exponential(means), ray.light);
}

vec4 radiance(Scattering s, float nu) {
  vec4 sum = s.rayleigh_like * rayleigh_phase(depolarisation, nu);
  for (int c = 0; c < kClasses; ++c) sum += s.single[c] * class_phase(c, nu);
  return sum;
}

// Both ends as upward rays, so that neither look-up meets the ground.
vec4 optical_depth_between(Place a, Place b, bool downward) {
  vec4 depth_between = downward ? optical_depth_to_top(b.h, -b.mu) - optical_depth_to_top(a.h, -a.mu)
                                : optical_depth_to_top(a.h, a.mu) - optical_depth_to_top(b.h, b.mu);
  return max(depth_between, 0.0);
}

vec4 transmittance_between(Place a, Place b, bool downward) { return exp(-optical_depth_between(a, b, downward)); }

// Into a path: what its whole ray gathers less what arrives of the rest beyond its end.
Scattering scattering_before(Scattering whole, vec4 transmittance, Scattering rest) {
  whole.rayleigh_like = max(whole.rayleigh_like - transmittance * rest.rayleigh_like, 0.0);
  for (int c = 0; c < kClasses; ++c) whole.single[c] = max(whole.single[c] - transmittance * rest.single[c], 0.0);
  return whole;
}
