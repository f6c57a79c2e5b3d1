// SPDX-License-Identifier: Apache-2.0
// The light of sky.frag on an sRGB display: colour, exposure, film curve with the hue that the light has, dither. The sun's
// disc is blended in as it is displayed, so that its edge is smooth.
#define BISECTIONS 12
#include "render/shaders/view_ray.glsl"
#include "render/shaders/view_transform.glsl"

in vec2 screen;
out vec4 color;

uniform sampler2D light_picture;
uniform sampler2D disc_picture;
uniform mat4 xyz_from_nodes;  // the last row is not used
uniform float exposure;       // m^2/cd

const mat3 kFromXyz = mat3(SRGB_FROM_XYZ);
const mat3 kXyzFrom = inverse(kFromXyz);

vec3 linear_display(vec4 nodes) {
  vec3 xyz = exposure * (xyz_from_nodes * nodes).xyz;
  vec3 scene = gamut_mapped(kFromXyz * xyz, xyz.y, kFromXyz, kXyzFrom);
  return displayed(scene, xyz.y, film_curve(xyz.y), kFromXyz, kXyzFrom);
}

// Uniform in 0..1.
float noise(uint index) {
  index ^= index >> 16u;
  index *= 0x7feb352du;
  index ^= index >> 15u;
  index *= 0x846ca68bu;
  index ^= index >> 16u;
  return float(index >> 8u) / 16777216.0;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 light = texelFetch(light_picture, pixel, 0);
  vec3 direction = normalize(ray_through(screen));
  float away = 2.0 * asin(clamp(0.5 * length(direction - suns[0].xyz), 0.0, 1.0));
  float cover = clamp((kSunRadius - away) / length(dFdx(direction)) + 0.5, 0.0, 1.0);
  vec4 with_disc = light + texelFetch(disc_picture, pixel, 0);
  vec3 shown = vec3(0.0);
  // A loop, so that compilers do not make the long function twice.
  for (int part = 0; part < 2; ++part) {
    float share = part == 0 ? 1.0 - cover : cover;
    if (share > 0.0) shown += share * linear_display(part == 0 ? light : with_disc);
  }
  vec3 encoded = vec3(srgb_transfer(shown.r), srgb_transfer(shown.g), srgb_transfer(shown.b));
  uint index = uint(pixel.y) * 65536u + uint(pixel.x);
  color = vec4(encoded + (noise(2u * index) - noise(2u * index + 1u)) / 255.0, 1.0);
}
