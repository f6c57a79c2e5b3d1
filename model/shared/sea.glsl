// SPDX-License-Identifier: Apache-2.0
// The surface of a sea under wind: slopes of Cox & Munk 1954, J. Opt. Soc. Am. 44, 838, without preferred direction.
// Cosines are those of zenith angles; a variance is that of the slope as a whole, of both axes. Compiled as double and as
// GLSL, see model/shared/sea.h.

// Cox & Munk 1954, of a clean surface; the wind is that at a height of 12.5 m.
Number sea_slope_variance(Number wind_m_s) { return 0.003 + 5.12e-3 * wind_m_s; }

// Fresnel's reflectance of sea water (refractive index 1.34) for natural light, by the cosine of the angle of incidence.
Number water_reflectance(Number cosine) {
  Number c = clamp(cosine, Number(0.0), Number(1.0));
  Number g = sqrt(1.34 * 1.34 - 1.0 + c * c);
  Number across = (g - c) / (g + c);
  Number along = (c * (g + c) - 1.0) / (c * (g - c) + 1.0);
  return 0.5 * across * across * (1.0 + along * along);
}

// How much of the facets toward a direction others hide, as Smith's Lambda for normally distributed slopes; the fit of
// Walter et al. 2007, eq. 22. 0 above about 15 degrees of height.
Number sea_masking(Number mu, Number variance) {
  Number m = clamp(mu, Number(1e-4), Number(0.99999));
  Number a = m / sqrt((1.0 - m * m) * variance);
  return a >= 1.6 ? Number(0.0) : (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 * a + 2.181 * a * a);
}

// The sun's glitter, 1/sr: radiance per unit irradiance of its beam (Cox & Munk 1954, eq. 9), with Smith's masking. mu_v and
// mu_s are toward the eye and the sun, nu is the cosine of the angle between the two.
Number sea_glitter(Number mu_v, Number mu_s, Number nu, Number variance) {
  if (mu_v <= 0.0 || mu_s <= 0.0) return Number(0.0);
  Number incidence = sqrt(max(0.5 * (1.0 + nu), Number(1e-12)));
  Number mu_n = clamp((mu_v + mu_s) / (2.0 * incidence), Number(1e-3), Number(1.0));
  Number square = mu_n * mu_n;
  Number slopes = exp((1.0 - 1.0 / square) / variance) / (3.14159265358979324 * variance);
  Number seen = 1.0 / (1.0 + sea_masking(mu_v, variance) + sea_masking(mu_s, variance));
  return water_reflectance(incidence) * slopes * seen / (4.0 * mu_v * square * square);
}

// The mean slope, toward the eye, of the facets that an eye sees: variance / 2 times the tangent of its zenith angle, and
// that of a normal distribution's steep half where it looks along the surface.
Number sea_seen_slope(Number mu_v, Number variance) {
  Number m = clamp(mu_v, Number(1e-4), Number(1.0));
  Number free = 0.5 * variance * sqrt(1.0 - m * m) / m;
  Number most = sqrt(0.785398163397448310 * variance);  // pi / 4
  return free * most / sqrt(free * free + most * most);
}
