// SPDX-License-Identifier: Apache-2.0
// A user's own colours and relief of the ground's two materials: pictures of a square of the ground, at two scales, near the eye
// and far away. They are laid on the ground from three sides, along the axes of the middle of a field of the globe: from above,
// and on slopes from the south and from the west. So that no lattice shows, pieces of the picture lie at random: each vertex of
// a lattice of triangles has its own offset, and inside a triangle the three pictures are blended (Deliot & Heitz 2019), their
// deviations from the mean scaled so that the contrast stays.

layout(std140, binding = 6) uniform OwnMaterials {
  mat3 field_axes;      // east, north and up, in the planet's axes
  vec4 own_repeats[4];  // of soil near and far, of rock near and far: repeats at the camera, 0 to 64; repeats per km
};
layout(binding = 20) uniform sampler2D soil_color;   // reflectances at the four nodes of the colour rule
layout(binding = 21) uniform sampler2D soil_slopes;  // of the relief, along the two axes of the picture, right and up
layout(binding = 22) uniform sampler2D rock_color;
layout(binding = 23) uniform sampler2D rock_slopes;

const int kLatticePeriod = 128;  // vertices: two to a repeat, 64 repeats

// An offset 0..1 for a vertex; its second coordinate is skewed by half of the first. Hash: Jarzynski & Olano 2020, pcg2d.
vec2 offset_of(ivec2 vertex) {
  int wrapped = vertex.y & (kLatticePeriod - 1);
  uvec2 v = uvec2((vertex.x + (vertex.y - wrapped) / 2) & (kLatticePeriod - 1), wrapped);
  v = v * 1664525u + 1013904223u;
  v.x += v.y * 1664525u;
  v.y += v.x * 1664525u;
  v ^= v >> 16u;
  v.x += v.y * 1664525u;
  v.y += v.x * 1664525u;
  v ^= v >> 16u;
  return vec2(v >> 8u) * (1.0 / 16777216.0);
}

// The mean of two points along a pixel's long side.
vec4 along_side(sampler2D map, vec2 at, vec2 side, float level) {
  return 0.5 * (textureLod(map, at - 0.25 * side, level) + textureLod(map, at + 0.25 * side, level));
}

// At a place in repeats; `side`: a pixel's long side; texels of the mipmap `level` are its short side.
vec4 without_lattice(sampler2D map, vec2 at, vec2 side, float level) {
  vec2 skewed = 2.0 * vec2(at.x - 0.5 * at.y, at.y);
  vec2 corner = floor(skewed), inside = skewed - corner;
  ivec2 base = ivec2(corner);
  bool upper = inside.x + inside.y > 1.0;
  vec3 weights = upper ? vec3(inside.x + inside.y - 1.0, 1.0 - inside.y, 1.0 - inside.x)
                       : vec3(1.0 - inside.x - inside.y, inside.y, inside.x);
  ivec2 first = upper ? base + 1 : base;
  ivec2 second = upper ? base + ivec2(1, 0) : base + ivec2(0, 1);
  ivec2 third = upper ? base + ivec2(0, 1) : base + ivec2(1, 0);
  vec4 mean = textureLod(map, vec2(0.5), 20.0);
  vec4 sum = weights.x * (along_side(map, at + offset_of(first), side, level) - mean) +
             weights.y * (along_side(map, at + offset_of(second), side, level) - mean) +
             weights.z * (along_side(map, at + offset_of(third), side, level) - mean);
  return mean + sum * inversesqrt(dot(weights, weights));
}

// Of a pixel on the ground; `place` relative to the camera and the others in the axes of the field, km.
struct Footprint {
  vec3 place, side, weights;  // weights of the views from the west, from the south and from above
  float short_km;
};

Footprint footprint_of(vec3 place, float d, vec3 ray, vec3 normal) {
  const float kMostSlant = 8.0;
  float cosine = max(abs(dot(ray, normal)), 1e-3);
  float slant = min(1.0 / cosine, kMostSlant);
  vec3 away = ray - dot(ray, normal) * normal;
  Footprint pixel;
  pixel.place = place * field_axes;  // by the transpose
  pixel.side = ((d * pixel_angle * slant * inversesqrt(max(dot(away, away), 1e-6))) * away) * field_axes;
  // What is longer than the most slant is blurred across, too.
  pixel.short_km = d * pixel_angle * max(0.5 * slant, 1.0) * max(1.0 / (cosine * slant), 1.0);
  vec3 facing = abs(normal * field_axes);
  vec3 steep = facing * facing * facing;
  pixel.weights = max(steep * steep / dot(steep, steep) - 0.02, 0.0);
  pixel.weights /= pixel.weights.x + pixel.weights.y + pixel.weights.z;
  return pixel;
}

struct Views {
  vec4 from_west, from_south, from_above;
};

Views views_of(sampler2D map, vec4 repeats, Footprint pixel) {
  vec3 at = repeats.xyz + repeats.w * pixel.place, side = repeats.w * pixel.side;
  float level = log2(max(repeats.w * pixel.short_km * float(textureSize(map, 0).x), 1e-6));
  Views views = Views(vec4(0.0), vec4(0.0), vec4(0.0));
  // The rows of a picture go down.
  const vec2 kRows = vec2(1.0, -1.0);
  if (pixel.weights.x > 0.0)
    views.from_west = pixel.weights.x * without_lattice(map, kRows * at.yz, kRows * side.yz, level);
  if (pixel.weights.y > 0.0)
    views.from_south = pixel.weights.y * without_lattice(map, kRows * at.xz, kRows * side.xz, level);
  if (pixel.weights.z > 0.0)
    views.from_above = pixel.weights.z * without_lattice(map, kRows * at.xy, kRows * side.xy, level);
  return views;
}

// Where a repeat near the eye is but a few pixels, the larger one takes its place: from 45 pixels to 11.
Views views_at_both_scales(sampler2D map, int near, Footprint pixel) {
  float far = smoothstep(0.5, 2.5, log2(max(64.0 * own_repeats[near].w * pixel.short_km, 1e-6)));
  Views views = Views(vec4(0.0), vec4(0.0), vec4(0.0)), distant = views;
  if (far < 1.0) views = views_of(map, own_repeats[near], pixel);
  if (far > 0.0) distant = views_of(map, own_repeats[near + 1], pixel);
  return Views(mix(views.from_west, distant.from_west, far), mix(views.from_south, distant.from_south, far),
               mix(views.from_above, distant.from_above, far));
}

vec4 own_color(sampler2D map, int near, Footprint pixel) {
  Views views = views_at_both_scales(map, near, pixel);
  return clamp(views.from_west + views.from_south + views.from_above, 0.0, 1.0);
}

// Of the relief, in the planet's axes.
vec3 own_gradient(sampler2D map, int near, Footprint pixel) {
  Views views = views_at_both_scales(map, near, pixel);
  vec3 gradient = vec3(views.from_south.x + views.from_above.x, views.from_west.x + views.from_above.y,
                       views.from_west.y + views.from_south.y);
  return field_axes * gradient;
}
