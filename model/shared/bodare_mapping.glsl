// SPDX-License-Identifier: Apache-2.0
// The mappings of Bodare & Sandberg 2014 (after Bruneton & Neyret 2008 and Yusov 2014), with the inverse corrected: the
// printed one lacks a factor 2 and mixes 0.75 with 1.1. Compiled as double, as dual numbers and as GLSL, see
// model/shared/shared.h; needs model/shared/mapping.glsl. Coordinates in 0..1 before half texels. Lengths in one unit.

Number bodare_unit_from_height(Number h, Number thickness) { return sqrt(max(h / thickness, Number(0.0))); }
Number bodare_height_from_unit(Number u_h, Number thickness) { return u_h * u_h * thickness; }

// Cosine of the zenith angle of the horizon.
Number bodare_horizon(Number h, Number bottom) { return -horizon_distance(h, bottom) / (bottom + h); }

// The view zenith, one half of the table for rays to the sky and one for rays to the ground: u_v is 0.5 + 0.5 x to the
// sky and 0.5 x to the ground, x = 0 at the horizon. The halves share no texel.
Number bodare_unit_from_sky_view(Number mu, Number horizon) {
  return pow(max((mu - horizon) / (Number(1.0) - horizon), Number(0.0)), Number(0.2));
}
Number bodare_sky_view_from_unit(Number x, Number horizon) {
  return horizon + pow(x, Number(5.0)) * (Number(1.0) - horizon);
}
Number bodare_unit_from_ground_view(Number mu, Number horizon) {
  return pow(max((horizon - mu) / (Number(1.0) + horizon), Number(0.0)), Number(0.2));
}
Number bodare_ground_view_from_unit(Number x, Number horizon) {
  return horizon - pow(x, Number(5.0)) * (Number(1.0) + horizon);
}

Number bodare_unit_from_sun(Number mu_s) {
  return 0.5 * (atan(max(mu_s, Number(-0.1975)) * 5.3496234992) / 1.1 + Number(0.74));  // tan(1.26 * 1.1)
}
Number bodare_sun_from_unit(Number u_s) { return tan((2.0 * u_s - Number(0.74)) * 1.1) / 5.3496234992; }
