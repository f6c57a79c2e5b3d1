// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/mie.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "model/numerics/clones.h"

namespace skyfit {
namespace {

using Complex = std::complex<double>;

// The order from which a recurrence of the argument z starts downward: what it starts with is
// forgotten from order |z| on, over a transition that is as wide as the cube root of |z|.
int first_order(double argument, int terms) {
  return std::max(terms, static_cast<int>(argument + 6 * std::cbrt(argument))) + 20;
}

// The logarithmic derivative D_n(z) of the Riccati-Bessel function psi_n, n = 0 .. terms.
std::vector<Complex> logarithmic_derivatives(Complex z, int terms) {
  std::vector<Complex> d(static_cast<std::size_t>(terms) + 1);
  Complex above = 0;
  for (int n = first_order(std::abs(z), terms); n > 0; --n) {
    const Complex ratio = static_cast<double>(n) / z;
    above = ratio - 1.0 / (above + ratio);
    if (n <= terms + 1) d[static_cast<std::size_t>(n) - 1] = above;
  }
  return d;
}

// psi_n(x), n = 0 .. terms: Miller's recurrence downward, scaled by the closed form of psi_0 or
// psi_1, whichever is farther from its zeros.
std::vector<double> riccati_bessel(double x, int terms) {
  std::vector<double> psi(static_cast<std::size_t>(terms) + 1);
  double above = 0, here = 1e-300;
  for (int n = first_order(x, terms); n >= 0; --n) {
    if (n <= terms) psi[static_cast<std::size_t>(n)] = here;
    const double below = (2 * n + 1) / x * here - above;
    above = here;
    here = below;
  }
  const double zeroth = std::sin(x), first = std::sin(x) / x - std::cos(x);
  const double scale = std::abs(zeroth) > std::abs(first) ? zeroth / psi[0] : first / psi[1];
  for (double& value : psi) value *= scale;
  return psi;
}

// x y_n(x), n = 0 .. terms.
std::vector<double> riccati_neumann(double x, int terms) {
  std::vector<double> eta = {-std::cos(x), -std::cos(x) / x - std::sin(x)};
  for (int n = 1; n < terms; ++n)
    eta.push_back((2 * n + 1) / x * eta[static_cast<std::size_t>(n)] -
                  eta[static_cast<std::size_t>(n) - 1]);
  return eta;
}

double norm_slope(Complex value, Complex slope) {
  return 2 * (value.real() * slope.real() + value.imag() * slope.imag());
}

// S1 and S2 of all angles, real and imaginary parts.
struct Amplitudes {
  explicit Amplitudes(std::size_t count)
      : real_1(count), imaginary_1(count), real_2(count), imaginary_2(count) {}
  std::vector<double> real_1, imaginary_1, real_2, imaginary_2;
};

SKYFIT_CLONES
void add_term(std::size_t count, const double* pi, const double* tau, double a_real,
              double a_imaginary, double b_real, double b_imaginary, double* real_1,
              double* imaginary_1, double* real_2, double* imaginary_2) {
  for (std::size_t i = 0; i < count; ++i) {
    real_1[i] += a_real * pi[i] + b_real * tau[i];
    imaginary_1[i] += a_imaginary * pi[i] + b_imaginary * tau[i];
    real_2[i] += a_real * tau[i] + b_real * pi[i];
    imaginary_2[i] += a_imaginary * tau[i] + b_imaginary * pi[i];
  }
}

Amplitudes amplitudes(const std::vector<Complex>& a, const std::vector<Complex>& b,
                      const MieAngles& angles) {
  Amplitudes s(angles.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    const int n = static_cast<int>(i) + 1;
    const double weight = (2.0 * n + 1) / (n * (n + 1.0));
    add_term(angles.size(), angles.pi(n), angles.tau(n), weight * a[i].real(), weight * a[i].imag(),
             weight * b[i].real(), weight * b[i].imag(), s.real_1.data(), s.imaginary_1.data(),
             s.real_2.data(), s.imaginary_2.data());
  }
  return s;
}

}  // namespace

int mie_terms(double x) { return static_cast<int>(x + 4.05 * std::cbrt(x) + 2) + 1; }

MieCoefficients mie_coefficients(double x, Complex index, bool by_index) {
  if (!(x > 0 && x <= kLargestSizeParameter)) {
    throw std::invalid_argument(fmt::format(
        "size parameter = {:.6g}: expected more than 0 and at most {}", x, kLargestSizeParameter));
  }
  if (!(index.real() > 0 && index.imag() >= 0)) {
    throw std::invalid_argument(fmt::format(
        "refractive index = {} + {} i: expected a real part > 0 and an imaginary part >= 0",
        index.real(), index.imag()));
  }
  const int terms = mie_terms(x);
  const Complex z = index * x;
  const std::vector<Complex> d = logarithmic_derivatives(z, terms);
  const std::vector<double> psi = riccati_bessel(x, terms), eta = riccati_neumann(x, terms);
  MieCoefficients c;
  for (int k = 1; k <= terms; ++k) {
    const auto n = static_cast<std::size_t>(k);
    const Complex xi(psi[n], eta[n]), xi_before(psi[n - 1], eta[n - 1]);
    const Complex electric = d[n] / index + k / x, magnetic = index * d[n] + k / x;
    const Complex a_below = electric * xi - xi_before, b_below = magnetic * xi - xi_before;
    c.a.push_back((electric * psi[n] - psi[n - 1]) / a_below);
    c.b.push_back((magnetic * psi[n] - psi[n - 1]) / b_below);
    if (!by_index) continue;
    // D' = n (n + 1) / z^2 - 1 - D^2; psi_n eta_{n-1} - psi_{n-1} eta_n = 1.
    const Complex slope = k * (k + 1.0) / (z * z) - 1.0 - d[n] * d[n];
    const Complex electric_slope = slope * x / index - d[n] / (index * index);
    const Complex magnetic_slope = d[n] + slope * z;
    constexpr Complex kI(0, 1);
    c.a_by_index.push_back(-kI * electric_slope / (a_below * a_below));
    c.b_by_index.push_back(-kI * magnetic_slope / (b_below * b_below));
  }
  return c;
}

MieEfficiencies mie_efficiencies(double x, const MieCoefficients& c) {
  MieEfficiencies q;
  for (std::size_t i = 0; i < c.a.size(); ++i) {
    const double weight = 2 / (x * x) * (2 * static_cast<double>(i) + 3);
    q.extinction += weight * (c.a[i] + c.b[i]).real();
    q.scattering += weight * (std::norm(c.a[i]) + std::norm(c.b[i]));
    if (c.a_by_index.empty()) continue;
    // Analytic functions: the derivative by k is i times that by n.
    const Complex by_n[2] = {c.a_by_index[i], c.b_by_index[i]};
    for (const int part : {0, 1}) {
      const Complex turn = part == 0 ? Complex(1, 0) : Complex(0, 1);
      q.extinction_by_index[part] += weight * (turn * (by_n[0] + by_n[1])).real();
      q.scattering_by_index[part] +=
          weight * (norm_slope(c.a[i], turn * by_n[0]) + norm_slope(c.b[i], turn * by_n[1]));
    }
  }
  return q;
}

double mie_asymmetry(double x, const MieCoefficients& c) {
  double sum = 0;
  for (std::size_t i = 0; i < c.a.size(); ++i) {
    const double n = static_cast<double>(i) + 1;
    sum += (2 * n + 1) / (n * (n + 1)) * (c.a[i] * std::conj(c.b[i])).real();
    if (i + 1 < c.a.size())
      sum += n * (n + 2) / (n + 1) *
             (c.a[i] * std::conj(c.a[i + 1]) + c.b[i] * std::conj(c.b[i + 1])).real();
  }
  return 4 / (x * x) * sum / mie_efficiencies(x, c).scattering;
}

MieAngles::MieAngles(std::vector<double> cosines, int terms)
    : cosines_(std::move(cosines)), terms_(terms) {
  const std::size_t count = size();
  pi_.resize(count * static_cast<std::size_t>(terms));
  tau_.resize(pi_.size());
  for (std::size_t i = 0; i < count; ++i) {
    const double mu = cosines_[i];
    double before = 0, here = 1;
    for (int n = 1; n <= terms; ++n) {
      const std::size_t at = static_cast<std::size_t>(n - 1) * count + i;
      pi_[at] = here;
      tau_[at] = n * mu * here - (n + 1) * before;
      const double next = ((2 * n + 1) * mu * here - (n + 1) * before) / n;
      before = here;
      here = next;
    }
  }
}

std::vector<MieMatrix> mie_matrix(double x, const MieCoefficients& c, const MieAngles& angles) {
  const std::size_t count = angles.size();
  const double unit = 1 / (2 * std::numbers::pi * x * x);
  const Amplitudes s = amplitudes(c.a, c.b, angles);
  std::vector<MieMatrix> result(c.a_by_index.empty() ? 1 : 3);
  for (MieMatrix& each : result)
    each = {std::vector<double>(count), std::vector<double>(count), std::vector<double>(count)};
  const Amplitudes by_n =
      c.a_by_index.empty() ? Amplitudes(0) : amplitudes(c.a_by_index, c.b_by_index, angles);
  for (std::size_t i = 0; i < count; ++i) {
    const Complex s1(s.real_1[i], s.imaginary_1[i]), s2(s.real_2[i], s.imaginary_2[i]);
    result[0].m11[i] = unit * (std::norm(s1) + std::norm(s2));
    result[0].m12[i] = unit * (std::norm(s2) - std::norm(s1));
    result[0].m33[i] = 2 * unit * (s1 * std::conj(s2)).real();
    for (std::size_t part = 1; part < result.size(); ++part) {
      const Complex turn = part == 1 ? Complex(1, 0) : Complex(0, 1);
      const Complex d1 = turn * Complex(by_n.real_1[i], by_n.imaginary_1[i]),
                    d2 = turn * Complex(by_n.real_2[i], by_n.imaginary_2[i]);
      const double slope_1 = norm_slope(s1, d1), slope_2 = norm_slope(s2, d2);
      result[part].m11[i] = unit * (slope_1 + slope_2);
      result[part].m12[i] = unit * (slope_2 - slope_1);
      result[part].m33[i] = 2 * unit * (d1 * std::conj(s2) + s1 * std::conj(d2)).real();
    }
  }
  return result;
}

}  // namespace skyfit
