// SPDX-License-Identifier: Apache-2.0
// Of an eye above a sphere in the sky of Nielsen 2003, which ends at a level horizon: the cosine of a ray's zenith angle
// there, 0 at the horizon that the eye sees, 1 at the zenith. Height and radius in the same unit.
Number nielsen_level_mu(Number mu, Number height, Number bottom) {
  Number horizon = -sqrt(max(height, Number(0.0)) * (2.0 * bottom + height)) / (bottom + height);
  return (mu - horizon) / (Number(1.0) - horizon);
}
