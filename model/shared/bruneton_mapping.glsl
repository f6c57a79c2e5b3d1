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

Number bruneton_unit_from_nu(Number nu) { return 0.5 * (nu + Number(1.0)); }
Number bruneton_nu_from_unit(Number x_nu) { return 2.0 * x_nu - Number(1.0); }
