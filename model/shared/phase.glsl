// SPDX-License-Identifier: Apache-2.0
// Phase functions, 1/sr: they integrate to 1 over the sphere; nu is the cosine of the scattering angle, g > 0 scatters
// forward. Compiled as double, as dual numbers and as GLSL, see model/shared/shared.h.

// Rayleigh scattering by molecules that depolarise natural light by the ratio rho at a right angle; 0 for spheres.
// Source: Chandrasekhar's formula as given by Bucholtz 1995, Appl. Opt. 34, 2765, with his gamma = rho / (2 - rho).
Number rayleigh_phase(Number depolarisation, Number nu) {
  return 0.119366207318921502 / (2.0 + depolarisation) *
         (1.0 + depolarisation + (1.0 - depolarisation) * nu * nu);  // 3 / (8 pi)
}

// The element of its matrix that polarises unpolarised light: Q in the frame of the scattering plane, negative, for the
// light is polarised at a right angle to that plane. docs/theory (13.2).
Number rayleigh_polarising_phase(Number depolarisation, Number nu) {
  return -0.119366207318921502 * (1.0 - depolarisation) / (2.0 + depolarisation) * (1.0 - nu * nu);  // 3 / (8 pi)
}

// Its second Legendre moment; the zeroth is 1, the others are 0.
Number rayleigh_second_moment(Number depolarisation) {
  return (1.0 - depolarisation) / (5.0 * (2.0 + depolarisation));
}

// Modified Rayleigh scattering of Elek 2009, as published: it integrates to 1.12.
Number elek_rayleigh_phase(Number nu) {
  return 0.0636619772367581343 * (1.4 + 0.5 * nu);  // (8 / 10) / (4 pi)
}

// Henyey & Greenstein 1941; its mean cosine is g.
Number henyey_greenstein_phase(Number g, Number nu) {
  Number d = 1.0 + g * g - 2.0 * g * nu;
  return 0.0795774715459476679 * (1.0 - g * g) / (d * sqrt(d));  // 1 / (4 pi)
}

// Cornette & Shanks 1992, eq. 8; g is a parameter, the mean cosine is 3 g (4 + g^2) / (5 (2 + g^2)).
Number cornette_shanks_phase(Number g, Number nu) {
  Number d = 1.0 + g * g - 2.0 * g * nu;
  return 0.119366207318921502 * (1.0 - g * g) * (1.0 + nu * nu) / ((2.0 + g * g) * d * sqrt(d));  // 3 / (8 pi)
}

// One lobe; `type` is a PhaseType of model/atmosphere/atmosphere.h: 0 Cornette-Shanks, 1 Henyey-Greenstein.
Number lobe_phase(int type, Number g, Number nu) {
  return type == 1 ? henyey_greenstein_phase(g, nu) : cornette_shanks_phase(g, nu);
}

// Two lobes of one type; weight is that of the first.
Number two_lobe_phase(int type, Number g1, Number g2, Number weight, Number nu) {
  return weight * lobe_phase(type, g1, nu) + (1.0 - weight) * lobe_phase(type, g2, nu);
}
