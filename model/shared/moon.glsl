// SPDX-License-Identifier: Apache-2.0
// The disc of a moon without an atmosphere, as dark dust shows it: the law of Lommel and Seeliger, by which a full moon is as
// bright at its limb as in its middle. Angles in radians. Compiled as double and as GLSL, see model/shared/moon.h.

// The light of the disc at a phase angle (sun, moon, eye), over that of the full one: the integral of the law over a sphere
// (Lester, McCall & Tatum 1979, J. R. Astron. Soc. Can. 73, 233).
Number moon_disc_light(Number phase) {
  Number half_phase = 0.5 * clamp(phase, Number(1e-3), Number(3.1));
  return 1.0 - sin(half_phase) * tan(half_phase) * log(1.0 / tan(0.5 * half_phase));
}

// Radiance of a place over the mean of the disc; mu and mu_0 are the cosines there toward the eye and the sun.
Number moon_brightness(Number mu, Number mu_0, Number phase) {
  return mu_0 <= 0.0 ? Number(0.0) : 2.0 * mu_0 / ((mu_0 + mu) * moon_disc_light(phase));
}
