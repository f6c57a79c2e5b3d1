// SPDX-License-Identifier: Apache-2.0
// The mappings of Bruneton 2017, "Precomputed Atmospheric Scattering: a New Implementation", functions.glsl, as they are
// published. Compiled as double, as dual numbers and as GLSL, see model/shared/shared.h; needs
// model/shared/geometry.glsl and model/shared/mapping.glsl, whose unit_from_upward_ray() and unit_from_ground_ray() are
// his two halves of the view zenith. Coordinates in 0..1 before half texels. Lengths in one unit.

// x_r = rho / H
Number bruneton_unit_from_height(Number h, Number bottom, Number thickness) {
  return horizon_distance(h, bottom) / longest_tangent(bottom, thickness);
}
Number bruneton_height_from_unit(Number x_r, Number bottom, Number thickness) {
  Number rho = x_r * longest_tangent(bottom, thickness);
  return rho * rho / (bottom + sqrt(bottom * bottom + rho * rho));
}

// a = (d - (Rt - Rg)) / (H - (Rt - Rg)), d the distance from the ground to the top along the sun's direction.
Number bruneton_sun_distance(Number mu_s, Number bottom, Number thickness) {
  Number d = distance_to_outer_sphere(bottom, Number(0.0), mu_s, thickness);
  return (d - thickness) / (longest_tangent(bottom, thickness) - thickness);
}
Number bruneton_unit_from_sun(Number mu_s, Number mu_s_min, Number bottom, Number thickness) {
  Number a = bruneton_sun_distance(mu_s, bottom, thickness);
  Number lowest = bruneton_sun_distance(mu_s_min, bottom, thickness);
  return max(Number(1.0) - a / lowest, Number(0.0)) / (Number(1.0) + a);
}
Number bruneton_sun_from_unit(Number x_mu_s, Number mu_s_min, Number bottom, Number thickness) {
  Number lowest = bruneton_sun_distance(mu_s_min, bottom, thickness);
  Number a = lowest * (Number(1.0) - x_mu_s) / (Number(1.0) + x_mu_s * lowest);
  Number tangent = longest_tangent(bottom, thickness);
  Number d = thickness + a * (tangent - thickness);
  return clamp((tangent * tangent - d * d) / (2.0 * bottom * d), Number(-1.0), Number(1.0));
}

// The same coordinates by radii, as they are published: squares of radii are subtracted, which in single precision leaves of
// the way to the ground near the horizon some kilometres. Whether a ray meets the ground, and x_mu of the two halves.
Number bruneton_discriminant(Number r, Number mu, Number bottom) {
  Number r_mu = r * mu;
  return r_mu * r_mu - r * r + bottom * bottom;
}
bool bruneton_meets_ground(Number r, Number mu, Number bottom) {
  return mu < Number(0.0) && bruneton_discriminant(r, mu, bottom) >= Number(0.0);
}
Number bruneton_horizon_distance(Number r, Number bottom) { return sqrt(max(r * r - bottom * bottom, Number(0.0))); }
Number bruneton_unit_from_radius(Number r, Number bottom, Number top) {
  return bruneton_horizon_distance(r, bottom) / bruneton_horizon_distance(top, bottom);
}
Number bruneton_ground_unit_by_radius(Number r, Number mu, Number bottom) {
  Number d = -r * mu - sqrt(max(bruneton_discriminant(r, mu, bottom), Number(0.0)));
  Number shortest = r - bottom;
  Number longest = bruneton_horizon_distance(r, bottom);
  return longest > shortest ? (d - shortest) / (longest - shortest) : Number(0.0);
}
Number bruneton_sky_unit_by_radius(Number r, Number mu, Number bottom, Number top) {
  Number tangent = bruneton_horizon_distance(top, bottom);
  Number d = -r * mu + sqrt(max(bruneton_discriminant(r, mu, bottom) + tangent * tangent, Number(0.0)));
  Number shortest = top - r;
  return (d - shortest) / (bruneton_horizon_distance(r, bottom) + tangent - shortest);
}

Number bruneton_unit_from_nu(Number nu) { return 0.5 * (nu + Number(1.0)); }
Number bruneton_nu_from_unit(Number x_nu) { return 2.0 * x_nu - Number(1.0); }
