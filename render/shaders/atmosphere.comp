// SPDX-License-Identifier: Apache-2.0
// The atmosphere as one pass over the G-buffer: the pixels of one class.
#include "render/shaders/pixel_light.glsl"
#include "render/shaders/pixel_class.glsl"

layout(binding = 8) uniform sampler2D depth;

layout(local_size_x = 8, local_size_y = 8) in;
layout(rgba32f, binding = 0) writeonly uniform image2D light;
layout(r32f, binding = 1) writeonly uniform image2D distance_km;
#ifdef LAYERS
layout(rgba32f, binding = 2) writeonly uniform image2D in_scatter_layer;
layout(rgba32f, binding = 3) writeonly uniform image2D reflected_layer;
layout(rgba32f, binding = 4) writeonly uniform image2D transmittance_layer;
layout(rgba32f, binding = 5) writeonly uniform image2D albedo_layer;
layout(rgba32f, binding = 6) writeonly uniform image2D normal_layer;
#endif

uniform float pixel_class, grainless_depth;

void main() {
  ivec2 pixel = ivec2(gl_GlobalInvocationID.xy), size = imageSize(light);
  if (any(greaterThanEqual(pixel, size))) return;
  vec3 site_ray = ray_through(2.0 * (vec2(pixel) + 0.5) / vec2(size) - 1.0);
  if (class_of(texelFetch(depth, pixel, 0).x, grainless_depth, site_ray) != pixel_class) return;
  Seen seen = seen_at(pixel, site_ray, planet_from_site * site_ray);
  imageStore(light, pixel, seen.light);
  imageStore(distance_km, pixel, vec4(seen.distance_km));
#ifdef LAYERS
  imageStore(in_scatter_layer, pixel, seen.in_scatter);
  imageStore(reflected_layer, pixel, seen.reflected);
  imageStore(transmittance_layer, pixel, seen.transmittance);
  imageStore(albedo_layer, pixel, seen.albedo);
  imageStore(normal_layer, pixel, seen.normal);
#endif
}
