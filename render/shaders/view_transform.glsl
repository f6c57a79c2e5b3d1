// SPDX-License-Identifier: Apache-2.0
// From linear light to what a display can show, with its hue. Compiled by C++ with glm's types of doubles
// (render/image/gamut.cc) and as GLSL, for which Number, and BISECTIONS of a share of 0..1, are defined. Colours are in the
// primaries of two matrices, from CIE 1931 XYZ and back.

// Narkowicz 2015, a fit of the ACES film curve; 0 to 0, about 0.8 at 1.
Number film_curve(Number x) {
  Number y = 0.8 * x;
  return clamp(y * (2.51 * y + 0.03) / (y * (2.43 * y + 0.59) + 0.14), Number(0.0), Number(1.0));
}

// IEC 61966-2-1.
Number srgb_transfer(Number x) {
  return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, Number(1.0 / 2.4)) - 0.055;
}

// Oklab, Ottosson 2020, https://bottosson.github.io/posts/oklab/: lightness, and two axes of colour about grey in which hues
// are straight lines. Homogeneous: k^3 times the light gives k times all three, so that hue and chroma / lightness do not
// depend on the exposure. Columns.
const mat3 kConesFromXyz = mat3(0.8189330101, 0.0329845436, 0.0482003018, 0.3618667424, 0.9293118715, 0.2643662691,
                                -0.1288597137, 0.0361456387, 0.6338517070);
const mat3 kLabFromRoots = mat3(0.2104542553, 1.9779984951, 0.0259040371, 0.7936177850, -2.4285922050, 0.7827717662,
                                -0.0040720468, 0.4505937099, -0.8086757660);
const mat3 kXyzFromCones = inverse(kConesFromXyz);
const mat3 kRootsFromLab = inverse(kLabFromRoots);

vec3 oklab_from(vec3 color, mat3 xyz_from) {
  vec3 cones = kConesFromXyz * (xyz_from * color);
  return kLabFromRoots * (sign(cones) * pow(abs(cones), vec3(1.0 / 3.0)));
}

vec3 color_from_oklab(vec3 lab, mat3 from_xyz) {
  vec3 roots = kRootsFromLab * lab;
  return from_xyz * (kXyzFromCones * (roots * roots * roots));
}

Number least_channel(vec3 color) { return min(color.x, min(color.y, color.z)); }
Number greatest_channel(vec3 color) { return max(color.x, max(color.y, color.z)); }

// Less chroma at the same luminance and hue, until no channel is negative. Light that the space holds stays as it is; what
// has no luminance becomes 0.
vec3 gamut_mapped(vec3 color, Number luminance, mat3 from_xyz, mat3 xyz_from) {
  if (least_channel(color) >= 0.0) return color;
  if (!(luminance > 0.0)) return vec3(0.0);
  vec3 lab = oklab_from(color, xyz_from);
  vec3 of_lightness_1 = vec3(1.0, lab.y / lab.x, lab.z / lab.x);
  Number low = 0.0, high = 1.0;
  for (int i = 0; i < BISECTIONS; ++i) {
    Number share = 0.5 * (low + high);
    vec3 tried = color_from_oklab(of_lightness_1 * vec3(1.0, share, share), from_xyz);
    if (least_channel(tried) >= 0.0) {
      low = share;
    } else {
      high = share;
    }
  }
  vec3 mapped = color_from_oklab(of_lightness_1 * vec3(1.0, low, low), from_xyz);
  mapped *= vec3(greaterThan(mapped, vec3(least_channel(mapped))));  // the least is 0 but for rounding
  return mapped * (luminance / (xyz_from * mapped).y);
}

// Linear light of a display whose channels are 0..1, of the same hue as `color`, which must not be negative. What is bright
// loses chroma, and little lightness: Ottosson 2021, "sRGB gamut clipping", towards a grey that depends on lightness and
// chroma; the more, the nearer a channel is to 1, so that no line shows where one would reach it.
vec3 display_mapped(vec3 color, mat3 from_xyz, mat3 xyz_from) {
  const Number kKeepChroma = 0.05;  // between the chroma, which 0 would keep, and the lightness
  const Number kStays = 0.85;       // of the way from the grey to the edge
  // Channels grow with the third power of that way at most.
  if (greatest_channel(color) <= kStays * kStays * kStays) return color;
  vec3 lab = oklab_from(color, xyz_from);
  Number off = lab.x - 0.5;
  Number e = 0.5 + abs(off) + kKeepChroma * length(vec2(lab.y, lab.z));
  Number step_to_grey = 0.5 * (e - sqrt(max(e * e - 2.0 * abs(off), Number(0.0))));
  Number grey = clamp(off < 0.0 ? 0.5 - step_to_grey : 0.5 + step_to_grey, Number(0.0), Number(1.0));
  vec3 from_grey = lab - vec3(grey, 0.0, 0.0);
  // Where the line from the grey through the colour leaves what can be shown, in units of the colour's distance.
  Number low = 0.0, high = 1.0 / kStays;
  for (int i = 0; i < BISECTIONS; ++i) {
    Number share = 0.5 * (low + high);
    if (greatest_channel(color_from_oklab(vec3(grey, 0.0, 0.0) + share * from_grey, from_xyz)) <= 1.0) {
      low = share;
    } else {
      high = share;
    }
  }
  Number over = max(1.0 / max(low, Number(1e-6)) - kStays, Number(0.0)) / (1.0 - kStays);
  Number share = low * (kStays + (1.0 - kStays) * (1.0 - exp(-over)));
  return clamp(color_from_oklab(vec3(grey, 0.0, 0.0) + min(share, Number(1.0)) * from_grey, from_xyz), vec3(0.0), vec3(1.0));
}

// The curve to the luminance; the hue stays, and its chroma as well but for lights far brighter than white, which films and
// eyes see as white.
vec3 displayed(vec3 color, Number luminance, Number curved_luminance, mat3 from_xyz, mat3 xyz_from) {
  const Number kHalfChroma = 16.0;  // at this luminance
  if (!(luminance > 0.0)) return vec3(0.0);
  vec3 lab = oklab_from(color, xyz_from);
  Number keep = 1.0 / (1.0 + luminance * luminance / (kHalfChroma * kHalfChroma));
  vec3 paler = max(color_from_oklab(lab * vec3(1.0, keep, keep), from_xyz), vec3(0.0));
  return display_mapped(paler * (curved_luminance / (xyz_from * paler).y), from_xyz, xyz_from);
}
