// SPDX-License-Identifier: Apache-2.0
// Scattering by a sphere has the published efficiencies, the limits of small and of large spheres,
// keeps energy where nothing is absorbed, and its matrix has its moments and slopes.
#include "model/atmosphere/mie.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "model/numerics/gauss.h"

namespace skyfit {
namespace {

using Complex = std::complex<double>;

struct Published {
  Complex index;
  double x, extinction, scattering, asymmetry;
};

// Wiscombe 1979, Mie scattering calculations, NCAR/TN-140+STR, test cases of the appendix; m = 1.55
// is the example of Bohren & Huffman 1983, appendix A.
constexpr double kDigits = 2e-6;  // the tables' last digit, twice: they round, and so do sums
const Published kPublished[] = {
    {{0.75, 0}, 0.099, 7.417859e-06, 7.417859e-06, 0.001448},
    {{0.75, 0}, 0.101, 8.033542e-06, 8.033542e-06, 0.001507},
    {{0.75, 0}, 10, 2.232265, 2.232265, 0.896473},
    {{0.75, 0}, 1000, 1.997908, 1.997908, 0.844944},
    {{1.33, 1e-5}, 1, 0.09395198, 0.09392330, 0.184517},
    {{1.33, 1e-5}, 100, 2.101321, 2.096594, 0.868959},
    {{1.33, 1e-5}, 10000, 2.004089, 1.723857, 0.907840},
    {{1.5, 1}, 0.055, 0.1014910, 1.131687e-05, 0.000491},
    {{1.5, 1}, 0.056, 0.1033467, 1.216311e-05, 0.000509},
    {{1.5, 1}, 1, 2.336321, 0.6634538, 0.192136},
    {{1.5, 1}, 100, 2.097502, 1.283697, 0.850252},
    {{1.5, 1}, 10000, 2.004368, 1.236574, 0.846309},
    {{10, 10}, 1, 2.532993, 2.049405, -0.110664},
    {{10, 10}, 100, 2.071124, 1.836785, 0.556215},
    {{10, 10}, 10000, 2.005914, 1.795393, 0.548194},
    {{1.55, 0}, 2 * std::numbers::pi * 0.525 / 0.6328, 3.10543, 3.10543, 0.63314}};

TEST(Mie, HasThePublishedEfficiencies) {
  for (const Published& p : kPublished) {
    const MieCoefficients c = mie_coefficients(p.x, p.index, false);
    const MieEfficiencies q = mie_efficiencies(p.x, c);
    const double digits = p.index.real() == 1.55 ? 1e-5 : kDigits;
    const auto expect_near = [&](double found, double expected) {
      EXPECT_NEAR(found, expected, digits * std::min(1.0, std::abs(expected)))
          << "m = " << p.index << ", x = " << p.x;
    };
    expect_near(q.extinction, p.extinction);
    expect_near(q.scattering, p.scattering);
    EXPECT_NEAR(mie_asymmetry(p.x, c), p.asymmetry, digits) << p.index << " " << p.x;
  }
}

// Q_sca = 8/3 x^4 |(m^2 - 1) / (m^2 + 2)|^2, Q_abs = 4 x Im((m^2 - 1) / (m^2 + 2)).
TEST(Mie, OfSmallSpheresIsRayleighs) {
  for (const Complex m : {Complex(1.33, 0), Complex(1.55, 0.02), Complex(1.75, 0.44)}) {
    constexpr double kX = 1e-3;
    const MieEfficiencies q = mie_efficiencies(kX, mie_coefficients(kX, m, false));
    const Complex ratio = (m * m - 1.0) / (m * m + 2.0);
    constexpr double kNextOrder = 5e-6;  // some x^2
    const double scattering = 8.0 / 3 * std::pow(kX, 4) * std::norm(ratio);
    EXPECT_NEAR(q.scattering / scattering, 1, kNextOrder);
    if (m.imag() > 0) {
      EXPECT_NEAR(q.extinction / (4 * kX * ratio.imag()), 1, kNextOrder);
    }
  }
}

TEST(Mie, KeepsEnergyWhereNothingIsAbsorbed) {
  for (const double m : {0.75, 1.33, 1.5, 2.2}) {
    for (const double x : {0.01, 0.3, 1.0, 7.7, 31.4159265358979, 123.4, 2000.0, 10000.0}) {
      const MieEfficiencies q = mie_efficiencies(x, mie_coefficients(x, m, false));
      // What is small is the real part of coefficients whose imaginary part is as 1 / x^3 to it.
      const double rounding = 1e-10 + 1e-15 / (x * x * x);
      EXPECT_NEAR(q.extinction / q.scattering, 1, rounding) << "m = " << m << ", x = " << x;
    }
  }
}

TEST(Mie, OfLargeSpheresTendsToTwo) {
  for (const double x : {3000.0, 10000.0}) {
    const MieEfficiencies q = mie_efficiencies(x, mie_coefficients(x, {1.5, 0.1}, false));
    const double edge =
        1.99 * std::pow(x, -2.0 / 3);  // of the term of the edge, van de Hulst 17.26
    EXPECT_NEAR(q.extinction, 2 + edge, 0.1 * edge);
  }
}

// The integral of the matrix over the sphere is the scattering efficiency, its first moment g.
TEST(Mie, MatrixHasItsMoments) {
  for (const double x : {0.1, 3.0, 40.0}) {
    for (const Complex m : {Complex(1.33, 0), Complex(1.5, 0.05)}) {
      const MieCoefficients c = mie_coefficients(x, m, false);
      const GaussRule rule = gauss_legendre(2 * static_cast<int>(c.a.size()) + 2);
      std::vector<double> cosines;
      std::vector<double> weights;
      for (std::size_t k = rule.node.size() / 2; k < rule.node.size(); ++k) {
        cosines.push_back(2 * rule.node[k] - 1);
        weights.push_back(4 * std::numbers::pi * rule.weight[k]);
      }
      const MieMatrix matrix = mie_matrix(x, c, cosines).front();
      double sum = 0, first = 0;
      ASSERT_EQ(matrix.m11.size(), 2 * cosines.size());
      for (std::size_t i = 0; i < matrix.m11.size(); ++i) {
        const std::size_t half = i % cosines.size();
        const double weight = weights[half],
                     cosine = i < cosines.size() ? cosines[half] : -cosines[half];
        sum += weight * matrix.m11[i];
        first += weight * matrix.m11[i] * cosine;
        const double rest = matrix.m11[i] * matrix.m11[i] - matrix.m12[i] * matrix.m12[i] -
                            matrix.m33[i] * matrix.m33[i];
        EXPECT_GE(rest, -1e-12 * matrix.m11[i] * matrix.m11[i]);  // m34^2
      }
      constexpr double kRounding = 1e-11;
      EXPECT_NEAR(sum / mie_efficiencies(x, c).scattering, 1, kRounding);
      EXPECT_NEAR(first / sum, mie_asymmetry(x, c), kRounding);
    }
  }
}

// m11 and m12 of a small sphere are those of a dipole: 1 + cos^2 and -sin^2.
TEST(Mie, MatrixOfSmallSpheresIsRayleighs) {
  constexpr double kX = 1e-3;
  const std::vector<double> cosines = {0, 0.4, 1};
  const MieCoefficients c = mie_coefficients(kX, {1.5, 0}, false);
  const MieMatrix matrix = mie_matrix(kX, c, cosines).front();
  for (std::size_t i = 0; i < matrix.m11.size(); ++i) {
    const double mu = i < 3 ? cosines[i] : -cosines[i - 3], unit = matrix.m11[2] / 2;
    constexpr double kNextOrder = 1e-5;
    EXPECT_NEAR(matrix.m11[i] / unit, 1 + mu * mu, kNextOrder);
    EXPECT_NEAR(matrix.m12[i] / unit, mu * mu - 1, kNextOrder);
    EXPECT_NEAR(matrix.m33[i] / unit, 2 * mu, kNextOrder);
  }
}

TEST(Mie, DerivativesByTheIndexAreExact) {
  const std::vector<double> cosines = {0.1, 0.3, 0.5, 0.6, 0.7, 0.75, 0.8, 0.9, 0.99, 1};
  for (const double x : {0.2, 5.0, 60.0}) {
    for (const Complex m : {Complex(1.4, 0.001), Complex(1.75, 0.44)}) {
      const auto efficiencies = [&](Complex index) {
        return mie_efficiencies(x, mie_coefficients(x, index, false));
      };
      const auto matrix = [&](Complex index) {
        return mie_matrix(x, mie_coefficients(x, index, false), cosines).front();
      };
      const MieCoefficients c = mie_coefficients(x, m, true);
      const MieEfficiencies q = mie_efficiencies(x, c);
      const std::vector<MieMatrix> exact = mie_matrix(x, c, cosines);
      constexpr double kStep = 1e-6;
      for (const int part : {0, 1}) {
        const Complex step = kStep * (part == 0 ? Complex(1, 0) : Complex(0, 1));
        const MieEfficiencies more = efficiencies(m + step), less = efficiencies(m - step);
        // The square of the step against that of the resonances, and rounding over the step.
        const auto expect_slope = [&](double slope, double above, double below, double scale) {
          EXPECT_NEAR(slope, (above - below) / (2 * kStep), 2e-5 * (std::abs(slope) + scale))
              << "x = " << x << ", m = " << m << ", part " << part;
        };
        expect_slope(q.extinction_by_index[part], more.extinction, less.extinction, q.extinction);
        expect_slope(q.scattering_by_index[part], more.scattering, less.scattering, q.scattering);
        const MieMatrix above = matrix(m + step), below = matrix(m - step);
        const auto at = static_cast<std::size_t>(part) + 1;
        for (std::size_t i = 0; i < exact[0].m11.size(); ++i) {
          const double scale = exact[0].m11[i];
          expect_slope(exact[at].m11[i], above.m11[i], below.m11[i], scale);
          expect_slope(exact[at].m12[i], above.m12[i], below.m12[i], scale);
          expect_slope(exact[at].m33[i], above.m33[i], below.m33[i], scale);
        }
      }
    }
  }
}

TEST(Mie, RefusesWhatItCannotDo) {
  EXPECT_THROW(mie_coefficients(0, {1.5, 0}, false), std::invalid_argument);
  EXPECT_THROW(mie_coefficients(1.1e4, {1.5, 0}, false), std::invalid_argument);
  EXPECT_THROW(mie_coefficients(NAN, {1.5, 0}, false), std::invalid_argument);
  EXPECT_THROW(mie_coefficients(1, {1.5, -0.1}, false), std::invalid_argument);
  EXPECT_THROW(mie_coefficients(1, {0, 0.1}, false), std::invalid_argument);
}

}  // namespace
}  // namespace skyfit
