// SPDX-License-Identifier: Apache-2.0
// The closed forms of the models without tables. Compiled as double, as dual numbers and as GLSL, see
// model/shared/shared.h. Lengths share one unit, which the caller chooses, unless a name says otherwise.

// Light that a path of one mixture scatters toward the eye, per unit irradiance of the sun on the path, 1/sr: beta are
// the scattering coefficients, phase the phase functions (1/sr), transmittance that of the path. Hoffman & Preetham
// 2002, eq. 10.
Number mixed_path_inscatter(Number air_beta, Number air_phase, Number aerosol_beta, Number aerosol_phase,
                            Number transmittance) {
  return (air_beta * air_phase + aerosol_beta * aerosol_phase) /
         max(air_beta + aerosol_beta, Number(1e-30)) * (Number(1.0) - transmittance);
}

// Relative optical air mass for the cosine of a zenith angle, 0 to 1. Kasten 1965, as Preetham, Shirley & Smits 1999 use
// it, appendix A.1.
Number relative_air_mass(Number mu) {
  Number zenith_deg = acos(clamp(mu, Number(0.0), Number(1.0))) * 57.29577951308232;
  return 1.0 / (max(mu, Number(0.0)) + 0.15 * pow(Number(93.885) - zenith_deg, Number(-1.253)));
}

// Nielsen 2003: what a ray from height_m to the sky crosses, metres of density 1, for the cosine of its zenith angle over a
// level horizon (nielsen_horizon.glsl). `zenith_depth_m` is that of the vertical ray.
Number nielsen_sky_depth(Number mu, Number zenith_depth_m) {
  Number f = pow(max(mu, Number(0.0)), Number(0.2));
  Number toward_horizon_m = (1.05 - f) * 190000.0;
  return toward_horizon_m + f * (zenith_depth_m - toward_horizon_m);
}
Number nielsen_air_zenith_depth(Number height_m) { return 20000.0 * exp(-height_m / 10000.0); }
Number nielsen_aerosol_zenith_depth(Number height_m) { return 8000.0 * exp(-height_m / 20000.0); }
Number nielsen_air_sky_depth(Number mu, Number height_m) {
  return nielsen_sky_depth(mu, nielsen_air_zenith_depth(height_m));
}
Number nielsen_aerosol_sky_depth(Number mu, Number height_m) {
  return nielsen_sky_depth(mu, nielsen_aerosol_zenith_depth(height_m));
}

// Nielsen 2003: mean of the densities at the two ends of a path near the terrain, times its length.
Number nielsen_terrain_depth(Number from_height_m, Number to_height_m, Number length_m, Number scale_height_m) {
  return 0.5 * (exp(-from_height_m / scale_height_m) + exp(-to_height_m / scale_height_m)) * length_m;
}

// The other mean of Nielsen 2003: the density at the mean height, times the length.
Number nielsen_mean_height_depth(Number from_height_m, Number to_height_m, Number length_m, Number scale_height_m) {
  return exp(-0.5 * (from_height_m + to_height_m) / scale_height_m) * length_m;
}

// Nielsen 2003: scale heights of paths near the terrain, m.
Number nielsen_air_scale_height() { return Number(15000.0); }
Number nielsen_aerosol_scale_height() { return Number(5000.0); }

// Nielsen 2003: the phase function of air that he draws with, 1/sr. It has less contrast than Rayleigh's, 1.25 in the
// place of 2, in the place of multiple scattering; its integral is 1.625.
Number nielsen_air_phase(Number nu) { return 0.05968310365946075 * (2.0 + 0.5 * nu * nu); }  // 3 / (16 pi)

// Nielsen 2003: the sun's light in haze over that in none, 9.2 - 550 times the factor on Hoffman & Preetham's Mie
// coefficient, over 9.2; beyond the thickest haze of the source, 7e-3, as in that.
Number nielsen_sunlight(Number mie_multiplier) {
  return Number(1.0) - (550.0 / 9.2) * min(mie_multiplier, Number(7e-3));
}

// Nielsen 2003: asymmetry of the aerosol from the eye's height, the sun's zenith angle (radians) and the amount of haze,
// as the factor on Hoffman & Preetham's Mie coefficient; `hazy_g` is that of thick haze.
Number nielsen_asymmetry(Number height_m, Number sun_zenith, Number mie_multiplier, Number hazy_g) {
  Number clear_g = 0.444 + 1.053e-5 * height_m - 5.984e-2 * sun_zenith - 3.521e-6 * height_m * sun_zenith;
  Number haze = clamp(153.85 * mie_multiplier - 0.0769, Number(0.0), Number(1.0));
  return clear_g + haze * (hazy_g - clear_g);
}

// O'Neil 2005: the slant column over the vertical one, for the cosine of the zenith angle; his polynomial for an
// atmosphere of 0.025 planet radii whose scale height is a quarter of its thickness.
Number oneil_slant(Number mu) {
  Number x = Number(1.0) - mu;
  return exp(-0.00287 + x * (0.459 + x * (3.83 + x * (-6.80 + x * 5.25))));
}
