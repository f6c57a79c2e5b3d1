// SPDX-License-Identifier: Apache-2.0
// The sky and the paths of Preetham, Shirley & Smits 1999. Compiled as double, as dual numbers and as GLSL, see
// model/shared/preetham.h.

// Preetham, Shirley & Smits 1999, appendix A.2: luminance, cd/m^2, and chromaticity of the sky over the turbidity t, for the
// cosine of the view's zenith angle, the angle from the sun and the sun's zenith angle, radians. The distribution is
//   F(Z, gamma) = (1 + A exp(B / cos Z)) (1 + C exp(D gamma) + E cos^2 gamma), over F(0, Z_sun).
Number preetham_distribution(Number mu, Number gamma, Number a, Number b, Number c, Number d, Number e) {
  Number nu = cos(gamma);
  return (Number(1.0) + a * exp(b / mu)) * (Number(1.0) + c * exp(d * gamma) + e * nu * nu);
}
Number preetham_relative(Number mu, Number gamma, Number sun_zenith, Number a, Number b, Number c, Number d, Number e) {
  return preetham_distribution(mu, gamma, a, b, c, d, e) /
         preetham_distribution(Number(1.0), sun_zenith, a, b, c, d, e);
}
Number preetham_luminance(Number t, Number mu, Number gamma, Number sun_zenith) {
  Number chi = (Number(0.4444444444444444) - t * 0.008333333333333333) * (Number(3.141592653589793) - 2.0 * sun_zenith);
  Number at_zenith = 1000.0 * ((4.0453 * t - 4.9710) * tan(chi) - 0.2155 * t + 2.4192);
  return at_zenith * preetham_relative(mu, gamma, sun_zenith, 0.1787 * t - 1.4630, -0.3554 * t + 0.4275,
                                       -0.0227 * t + 5.3251, 0.1206 * t - 2.5771, -0.0670 * t + 0.3703);
}
Number preetham_x(Number t, Number mu, Number gamma, Number sun_zenith) {
  Number s = sun_zenith;
  Number at_zenith = ((((0.00166 * s - 0.00375) * s + 0.00209) * s) * t +
                      (((-0.02903 * s + 0.06377) * s - 0.03202) * s + 0.00394)) * t +
                     (((0.11693 * s - 0.21196) * s + 0.06052) * s + 0.25886);
  return at_zenith * preetham_relative(mu, gamma, sun_zenith, -0.0193 * t - 0.2592, -0.0665 * t + 0.0008,
                                       -0.0004 * t + 0.2125, -0.0641 * t - 0.8989, -0.0033 * t + 0.0452);
}
Number preetham_y(Number t, Number mu, Number gamma, Number sun_zenith) {
  Number s = sun_zenith;
  Number at_zenith = ((((0.00275 * s - 0.00610) * s + 0.00317) * s) * t +
                      (((-0.04214 * s + 0.08970) * s - 0.04153) * s + 0.00516)) * t +
                     (((0.15346 * s - 0.26756) * s + 0.06670) * s + 0.26688);
  return at_zenith * preetham_relative(mu, gamma, sun_zenith, -0.0167 * t - 0.2608, -0.0950 * t + 0.0092,
                                       -0.0079 * t + 0.2102, -0.0441 * t - 1.6537, -0.0109 * t + 0.0529);
}

// Preetham, Shirley & Smits 1999, section 4: an exponential density along a path over which the height changes evenly,
// metres of density 1. By its series where the heights are near each other.
Number preetham_path_depth(Number from_height_m, Number to_height_m, Number length_m, Number scale_height_m) {
  Number x = (to_height_m - from_height_m) / scale_height_m;
  Number mean = x * x < 1e-4 ? Number(1.0) - 0.5 * x + x * x * 0.16666666666666666 : (Number(1.0) - exp(-x)) / x;
  return exp(-from_height_m / scale_height_m) * mean * length_m;
}
