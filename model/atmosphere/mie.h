// SPDX-License-Identifier: Apache-2.0
// Scattering by one homogeneous sphere (Mie), after Bohren & Huffman 1983, chapter 4: size
// parameter x = 2 pi radius / wavelength, up to 10 000; refractive index m = n + i k relative to
// the air around it, k >= 0 absorbs. Efficiencies are cross sections over pi radius^2; all are pure
// numbers.
// The logarithmic derivative of the field inside and the Bessel functions outside come from
// recurrences downward, so that neither a large x nor a strong absorption loses digits (Wiscombe
// 1980, Appl. Opt. 19, 1505-1509, with his number of terms).
#pragma once

#include <complex>
#include <vector>

namespace skyfit {

inline constexpr double kSmallestSizeParameter = 1e-12, kLargestSizeParameter = 1e4;

// a[i] and b[i] belong to n = i + 1; by_index are their derivatives by m, analytic functions of it.
struct MieCoefficients {
  std::vector<std::complex<double>> a, b, a_by_index, b_by_index;
};
// Without the derivatives unless they are wanted. Throws std::invalid_argument unless
// 1e-12 <= x <= 10 000, n > 0 and k >= 0.
MieCoefficients mie_coefficients(double x, std::complex<double> index, bool by_index);

// Of both and of their derivatives by n and k (0 unless the coefficients have them).
struct MieEfficiencies {
  double extinction = 0, scattering = 0;
  double extinction_by_index[2] = {0, 0}, scattering_by_index[2] = {0, 0};  // by n, by k
};
MieEfficiencies mie_efficiencies(double x, const MieCoefficients& c);

// Mean cosine of the scattering angle, from the coefficients alone.
double mie_asymmetry(double x, const MieCoefficients& c);

// The scattering matrix at each angle, per unit of pi radius^2 and steradian: its integral over the
// sphere is the scattering efficiency.
//   m11 = (|S1|^2 + |S2|^2) / (2 pi x^2), m12 = (|S2|^2 - |S1|^2) / (2 pi x^2),
// with Q of (I, Q) positive in the scattering plane. m22 is m11. m33 = Re(S1 S2*) / (pi x^2).
struct MieMatrix {
  std::vector<double> m11, m12, m33;
};
// At the angles whose cosines are given, >= 0, followed by those at 180 deg less each of them, in
// the same order. [0], and with derivatives of the coefficients [1] and [2], by n and by k.
std::vector<MieMatrix> mie_matrix(double x, const MieCoefficients& c,
                                  const std::vector<double>& forward_cosines);

}  // namespace skyfit
