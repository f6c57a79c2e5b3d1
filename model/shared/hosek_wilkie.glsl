// SPDX-License-Identifier: Apache-2.0
// The sky of Hosek & Wilkie 2012. Compiled as double, as dual numbers and as GLSL, see model/shared/shared.h.

// What the Bezier curves of degree 5 of their numbers run over, 0 to 1: (solar elevation / 90 deg)^(1/3), for the sun's zenith
// angle, radians.
Number hosek_wilkie_elevation(Number sun_zenith) {
  return pow(max(Number(1.0) - sun_zenith * 0.6366197723675814, Number(0.0)), Number(0.3333333333333333));  // 2 / pi
}
// Weight of a curve's control point, 0 to 5.
Number hosek_wilkie_weight(int point, Number elevation) {
  Number rest = Number(1.0) - elevation;
  Number below = point == 0 ? Number(1.0) : point == 1 ? 5.0 * elevation : 10.0 * elevation * elevation;
  Number above = rest * rest * rest;
  if (point == 3) return below * elevation * rest * rest;
  if (point == 4) return below * elevation * elevation * rest * 0.5;
  if (point == 5) return below * elevation * elevation * elevation * 0.1;
  return below * above * (point == 0 ? rest * rest : point == 1 ? rest : Number(1.0));
}

// Eq. 8, for the cosine of the view's zenith angle, the angle from the sun, radians, and its cosine: X, Y or Z, cd/m^2, where
// `mean` is L_mean, W m^-2 sr^-1 nm^-1 summed with a colour matching function.
Number hosek_wilkie_light(Number mu, Number gamma, Number nu, Number a, Number b, Number c, Number d, Number e, Number f,
                          Number g, Number h, Number i, Number mean) {
  Number denominator = Number(1.0) + h * h - 2.0 * nu * h;
  Number chi = (Number(1.0) + nu * nu) / (denominator * sqrt(denominator));
  return 683.0 * mean * (Number(1.0) + a * exp(b / (mu + 0.01))) *
         (c + d * exp(e * gamma) + f * nu * nu + g * chi + i * sqrt(mu));
}
