// SPDX-License-Identifier: Apache-2.0
// A user's own colours and relief of the ground's two materials: pictures of a square of the ground, at two scales, near the eye
// and far away. They are laid on the ground from three sides, along the axes of the middle of a field of the globe: from above,
// and on slopes from the south and from the west. So that no lattice shows, pieces of the picture lie at random: each vertex of
// a lattice of triangles has its own offset, and inside a triangle the three pictures are blended (Deliot & Heitz 2019), their
// deviations from the mean scaled so that the contrast stays.

layout(std140, binding = 6) uniform OwnMaterials {
  mat3 field_axes;      // east, north and up, in the planet's axes
  vec4 own_repeats[4];  // of soil near and far, of rock near and far: repeats at the camera, 0 to 64; repeats per km
  vec4 own_means[4];    // of the pictures in the order of their bindings
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

// The vertices of the triangle about a place in repeats, and their weights: fourth powers, of which most are nothing, over the
// length of all of them, so that the contrast stays.
struct Corners {
  ivec2 vertex[3];
  vec3 weights;
};

Corners corners_of(vec2 at) {
  vec2 skewed = 2.0 * vec2(at.x - 0.5 * at.y, at.y);
  vec2 corner = floor(skewed), inside = skewed - corner;
  ivec2 base = ivec2(corner);
  bool upper = inside.x + inside.y > 1.0;
  Corners corners;
  corners.vertex = ivec2[3](upper ? base + 1 : base, base + (upper ? ivec2(1, 0) : ivec2(0, 1)),
                            base + (upper ? ivec2(0, 1) : ivec2(1, 0)));
  vec3 weights = upper ? vec3(inside.x + inside.y - 1.0, 1.0 - inside.y, 1.0 - inside.x)
                       : vec3(1.0 - inside.x - inside.y, inside.y, inside.x);
  weights *= weights;
  weights *= weights;
  weights = max(weights / (weights.x + weights.y + weights.z) - 0.01, 0.0);
  corners.weights = weights * inversesqrt(dot(weights, weights));
  return corners;
}

// Of a pixel on the ground; `place` relative to the camera and `side`, its long side, in the axes of the field, km.
struct Footprint {
  vec3 place, side, weights;  // weights of the views from the west, from the south and from above
  float short_km;
  int points;  // along the long side
};

Footprint footprint_of(vec3 place, float d, vec3 ray, vec3 normal) {
  const float kMostSlant = 8.0;  // what is longer is blurred across, too
  float cosine = max(abs(dot(ray, normal)), 1e-3);
  float slant = min(1.0 / cosine, kMostSlant);
  vec3 away = ray - dot(ray, normal) * normal;
  Footprint pixel;
  pixel.place = place * field_axes;  // by the transpose
  pixel.side = ((d * pixel_angle * slant * inversesqrt(max(dot(away, away), 1e-6))) * away) * field_axes;
  pixel.points = clamp(int(ceil(slant - 0.25)), 1, int(kMostSlant));
  pixel.short_km = d * pixel_angle * max(slant / float(pixel.points), 1.0) * sqrt(1.0 / (cosine * slant));
  vec3 facing = abs(normal * field_axes);
  vec3 steep = facing * facing * facing;
  pixel.weights = max(steep * steep / dot(steep, steep) - 0.02, 0.0);
  pixel.weights /= pixel.weights.x + pixel.weights.y + pixel.weights.z;
  return pixel;
}

struct OwnMaterial {
  vec4 reflectance;
  vec3 gradient;  // of the relief, in the planet's axes
};

float mipmap_of(sampler2D map, float repeats_per_km, Footprint pixel) {
  return log2(max(repeats_per_km * pixel.short_km * float(textureSize(map, 0).x), 1e-6));
}

// `near`: the place of the scale near the eye in own_repeats; means of the two pictures. One loop for all scales, views and
// corners: written out, the fetches are so many that Mesa's compiler takes minutes.
OwnMaterial own_material(sampler2D colors, sampler2D slopes, vec4 mean_color, vec4 mean_slopes, int near, Footprint pixel) {
  OwnMaterial own = OwnMaterial(mean_color, vec3(0.0));
  // Where a repeat near the eye is but a few pixels, the larger one takes its place: from 45 pixels to 11.
  float far = smoothstep(0.5, 2.5, log2(max(64.0 * own_repeats[near].w * pixel.short_km, 1e-6)));
  for (int i = 0; i < 6; ++i) {
    bool is_far = i >= 3, from_west = i % 3 == 0, from_south = i % 3 == 1;
    float weight = (is_far ? far : 1.0 - far) *
                   (from_west ? pixel.weights.x : from_south ? pixel.weights.y : pixel.weights.z);
    if (weight <= 0.0) continue;
    vec4 repeats = is_far ? own_repeats[near + 1] : own_repeats[near];
    vec3 place = repeats.xyz + repeats.w * pixel.place, long_side = repeats.w * pixel.side;
    // The rows of a picture go down.
    const vec2 kRows = vec2(1.0, -1.0);
    vec2 at = kRows * (from_west ? place.yz : from_south ? place.xz : place.xy);
    vec2 side = kRows * (from_west ? long_side.yz : from_south ? long_side.xz : long_side.xy);
    float color_level = mipmap_of(colors, repeats.w, pixel), slope_level = mipmap_of(slopes, repeats.w, pixel);
    Corners corners = corners_of(at);
    vec2 slope = mean_slopes.xy;
    for (int k = 0; k < 3 * pixel.points; ++k) {
      int corner = k / pixel.points;
      float share = (corner == 0 ? corners.weights.x : corner == 1 ? corners.weights.y : corners.weights.z) /
                    float(pixel.points);
      if (share <= 0.0) continue;
      ivec2 vertex = corner == 0 ? corners.vertex[0] : corner == 1 ? corners.vertex[1] : corners.vertex[2];
      vec2 point = at + offset_of(vertex) + ((float(k % pixel.points) + 0.5) / float(pixel.points) - 0.5) * side;
      own.reflectance += weight * share * (textureLod(colors, point, color_level) - mean_color);
      slope += share * (textureLod(slopes, point, slope_level).xy - mean_slopes.xy);
    }
    own.gradient += weight * (from_west    ? vec3(0.0, slope)
                              : from_south ? vec3(slope.x, 0.0, slope.y)
                                           : vec3(slope, 0.0));
  }
  own.reflectance = clamp(own.reflectance, 0.0, 1.0);
  own.gradient = field_axes * own.gradient;
  return own;
}
