// SPDX-License-Identifier: Apache-2.0
// Wigner's functions d^l_{2n} of rotations about an axis across the line of sight: what Legendre's
// are for radiance, they are for linear polarisation, docs/theory (13.17).
#pragma once

namespace skyfit {

// d^l_{2n}(theta) for l = 0 .. count - 1, 0 below l = max(2, |n|), to out[0 .. count); mu = cos
// theta. d^2_{20} = sqrt(6) / 4 sin^2 theta, d^2_{2,+-2} = (1 +- mu)^2 / 4.
void wigner_d2(int n, int count, double mu, double* out);

}  // namespace skyfit
