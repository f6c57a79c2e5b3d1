// SPDX-License-Identifier: Apache-2.0
// Densities relative to their reference height. Compiled as double, as dual numbers and as GLSL, see
// model/shared/shared.h. Lengths share one unit, which the caller chooses.

// rho(h) = exp(-h / H), 1 at h = 0.
Number exponential_density(Number height, Number scale_height) { return exp(-height / scale_height); }
