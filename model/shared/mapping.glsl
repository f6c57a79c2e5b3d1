// SPDX-License-Identifier: Apache-2.0
// The mappings between rays and look-up tables. Source: Bruneton 2017, "Precomputed Atmospheric Scattering: a New
// Implementation", functions.glsl. Deviation: a point is given by its height h above the bottom radius instead of its
// distance r from the centre, and every difference of squares is factored, so that single precision keeps its digits:
// r = 6 360 000 m resolves half a metre in a float, h = 2 m resolves a micrometre.
// Compiled as double, as dual numbers and as GLSL, see model/shared/shared.h; needs model/shared/geometry.glsl.
//
// Lengths in any one unit: `bottom` is the planet's radius, `thickness` the height of the top of the atmosphere.
// mu = cos(view zenith) and mu_s = cos(sun zenith) at the point; x_* is a table coordinate in [0, 1], before half texels
// are taken into account; hits_ground says which half of the scattering table a view ray belongs to.

// Distance to the tangent point on the ground: sqrt(r^2 - bottom^2).
Number horizon_distance(Number h, Number bottom) {
  return sqrt(max(h * (2.0 * bottom + h), Number(0.0)));
}

// Length of a tangent to the ground, from the ground to the top of the atmosphere: H of Bruneton 2017.
Number longest_tangent(Number bottom, Number thickness) {
  return horizon_distance(thickness, bottom);
}

// Whether the ray meets the ground sphere.
bool ray_hits_ground(Number h, Number mu, Number bottom) {
  return -(bottom + h) * mu > horizon_distance(h, bottom);
}

// Texture coordinate of x in [0, 1] in a table of `size` texels: half a texel, so that 0 and 1 hit texel centres.
Number texture_from_unit(Number x, Number size) { return 0.5 / size + x * (1.0 - 1.0 / size); }
Number unit_from_texture(Number u, Number size) { return (u - 0.5 / size) / (1.0 - 1.0 / size); }

Number unit_from_height(Number h, Number bottom, Number thickness) {
  return horizon_distance(h, bottom) / longest_tangent(bottom, thickness);
}

Number height_from_unit(Number x_r, Number bottom, Number thickness) {
  Number rho = x_r * longest_tangent(bottom, thickness);
  return rho * rho / (sqrt(rho * rho + bottom * bottom) + bottom);
}

// Rays that leave through the top; this is the whole mapping of the transmittance table and the upper half of the
// scattering table.
Number unit_from_upward_ray(Number h, Number mu, Number bottom, Number thickness) {
  Number shortest = thickness - h;
  Number longest = horizon_distance(h, bottom) + longest_tangent(bottom, thickness);
  Number d = distance_to_outer_sphere(bottom, h, mu, thickness);
  return clamp((d - shortest) / (longest - shortest), Number(0.0), Number(1.0));
}

Number mu_from_upward_unit(Number x_mu, Number h, Number bottom, Number thickness) {
  Number shortest = thickness - h;
  Number longest = horizon_distance(h, bottom) + longest_tangent(bottom, thickness);
  Number d = shortest + x_mu * (longest - shortest);
  Number above = (thickness - h) * (2.0 * bottom + thickness + h);  // top^2 - r^2
  Number mu = (above - d * d) / max(2.0 * (bottom + h) * d, Number(1e-30));
  return d > Number(0.0) ? clamp(mu, Number(-1.0), Number(1.0)) : Number(1.0);
}

// Rays that end on the ground: the lower half of the scattering table.
Number unit_from_ground_ray(Number h, Number mu, Number bottom) {
  Number longest = horizon_distance(h, bottom);
  Number d = distance_to_inner_sphere(bottom, h, mu, Number(0.0));
  Number unit = (d - h) / max(longest - h, Number(1e-30));
  return longest > h ? clamp(unit, Number(0.0), Number(1.0)) : Number(0.0);
}

Number mu_from_ground_unit(Number x_mu, Number h, Number bottom) {
  Number longest = horizon_distance(h, bottom);
  Number d = h + x_mu * (longest - h);
  Number mu = -(longest * longest + d * d) / max(2.0 * (bottom + h) * d, Number(1e-30));
  return d > Number(0.0) ? clamp(mu, Number(-1.0), Number(1.0)) : Number(-1.0);
}

// The sun's height: distances from the ground to the top, resolved best near the horizon; mu_s_min is the lowest sun in
// the table.
Number sun_curve(Number mu_s, Number bottom, Number thickness) {
  Number d = distance_to_outer_sphere(bottom, Number(0.0), mu_s, thickness);
  return (d - thickness) / (longest_tangent(bottom, thickness) - thickness);
}

Number unit_from_sun(Number mu_s, Number mu_s_min, Number bottom, Number thickness) {
  Number a = sun_curve(max(mu_s, mu_s_min), bottom, thickness);
  Number lowest = sun_curve(mu_s_min, bottom, thickness);
  return max(1.0 - a / lowest, Number(0.0)) / (1.0 + a);
}

Number sun_from_unit(Number x_mu_s, Number mu_s_min, Number bottom, Number thickness) {
  Number lowest = sun_curve(mu_s_min, bottom, thickness);
  Number a = lowest * (1.0 - x_mu_s) / (1.0 + x_mu_s * lowest);
  Number tangent = longest_tangent(bottom, thickness);
  Number d = thickness + a * (tangent - thickness);
  Number mu_s = (tangent * tangent - d * d) / (2.0 * bottom * d);
  return clamp(mu_s, Number(-1.0), Number(1.0));
}

// The angle between sun and view: the sine of its half, finest toward the sun, where the light changes most. Deviation:
// Bruneton 2017 takes the cosine.
Number unit_from_cosine(Number cosine) {
  return 1.0 - sqrt(max(0.5 - 0.5 * cosine, Number(0.0)));
}
Number cosine_from_unit(Number x) { return 1.0 - 2.0 * (1.0 - x) * (1.0 - x); }

// Rays to the sky, whose brightness changes fastest along the limb: coordinate of the square root of Bruneton's
// distance, x = s at both ends, 1.6 times as coarse as s at the zenith and 2.5 times as fine at the horizon.
Number sky_from_root(Number s) { return (1.6 - sqrt(max(2.56 - 2.4 * s, Number(0.0)))) / 1.2; }
Number root_from_sky(Number x) { return x * (1.6 - 0.6 * x); }

// Texture coordinate of the view zenith in the scattering table: the halves meet at the horizon and share no texel.
// Deviation: the square root of Bruneton's distance, which spreads the texels over the sky instead of one over the
// 30 degrees about the zenith.
Number texture_from_view(Number h, Number mu, bool hits_ground, Number size, Number bottom, Number thickness) {
  Number half_size = 0.5 * size;
  if (hits_ground) {
    return 0.5 - 0.5 * texture_from_unit(sqrt(unit_from_ground_ray(h, mu, bottom)), half_size);
  }
  return 0.5 + 0.5 * texture_from_unit(sky_from_root(sqrt(unit_from_upward_ray(h, mu, bottom, thickness))), half_size);
}

Number mu_from_texture(Number u, Number h, Number size, Number bottom, Number thickness) {
  Number half_size = 0.5 * size;
  if (u < Number(0.5)) {
    Number ground = unit_from_texture(1.0 - 2.0 * u, half_size);
    return mu_from_ground_unit(ground * ground, h, bottom);
  }
  Number sky = root_from_sky(unit_from_texture(2.0 * u - 1.0, half_size));
  return mu_from_upward_unit(sky * sky, h, bottom, thickness);
}

// Where a view ray meets the atmosphere when the eye may be outside: distance to the first point inside, 0 when the eye
// is inside, negative when the ray misses. (bottom + h) is the eye's distance from the centre.
Number distance_to_atmosphere(Number h, Number mu, Number bottom, Number thickness) {
  if (h < thickness) return Number(0.0);
  Number along = -(bottom + h) * mu;
  Number outside = (h - thickness) * (2.0 * bottom + thickness + h);  // r^2 - top^2
  Number rest = along * along - outside;
  if (along < Number(0.0) || rest < Number(0.0)) return Number(-1.0);
  return outside / (along + sqrt(rest));
}
