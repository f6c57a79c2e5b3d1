// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/mie.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>

#include "model/numerics/clones.h"

namespace skyfit {
namespace {

using Complex = std::complex<double>;

// Without the care for infinities of the operator /, which costs as much as the rest: of numbers
// whose squares neither overflow nor vanish, as here down to kSmallestSizeParameter.
Complex ratio_of(Complex above, Complex below) {
  const double norm = below.real() * below.real() + below.imag() * below.imag();
  return {(above.real() * below.real() + above.imag() * below.imag()) / norm,
          (above.imag() * below.real() - above.real() * below.imag()) / norm};
}

// The order from which a recurrence of the argument z starts downward: what it starts with is
// forgotten from order |z| on, over a transition that is as wide as the cube root of |z|.
int first_order(double argument, int terms) {
  return std::max(terms, static_cast<int>(argument + 6 * std::cbrt(argument))) + 20;
}

// The logarithmic derivative D_n(z) of the Riccati-Bessel function psi_n, n = 0 .. terms.
std::vector<Complex> logarithmic_derivatives(Complex z, int terms) {
  std::vector<Complex> d(static_cast<std::size_t>(terms) + 1);
  Complex above = 0;
  const Complex inverse = ratio_of(1, z);
  for (int n = first_order(std::abs(z), terms); n > 0; --n) {
    const Complex ratio = static_cast<double>(n) * inverse;
    above = ratio - ratio_of(1, above + ratio);
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

// Wiscombe 1980.
int terms_of(double x) { return static_cast<int>(x + 4.05 * std::cbrt(x) + 2) + 1; }

double norm_slope(Complex value, Complex slope) {
  return 2 * (value.real() * slope.real() + value.imag() * slope.imag());
}

// S1 + S2 and S1 - S2 at some cosines mu and at -mu; real and imaginary parts.
constexpr int kBatch = 8;
struct Amplitudes {
  using Batch = std::array<double, kBatch>;
  Batch sum_real{}, sum_imaginary{}, difference_real{}, difference_imaginary{};
  Batch back_sum_real{}, back_sum_imaginary{}, back_difference_real{}, back_difference_imaginary{};

  Complex first(std::size_t i, bool back) const {
    return 0.5 * (sum(i, back) + difference(i, back));
  }
  Complex second(std::size_t i, bool back) const {
    return 0.5 * (sum(i, back) - difference(i, back));
  }

 private:
  Complex sum(std::size_t i, bool back) const {
    return back ? Complex(back_sum_real[i], back_sum_imaginary[i])
                : Complex(sum_real[i], sum_imaginary[i]);
  }
  Complex difference(std::size_t i, bool back) const {
    return back ? Complex(back_difference_real[i], back_difference_imaginary[i])
                : Complex(difference_real[i], difference_imaginary[i]);
  }
};

// With pi_n(-mu) = (-1)^(n+1) pi_n(mu) and tau_n(-mu) = (-1)^n tau_n(mu); `a` and `b` hold real and
// imaginary parts after each other.
SKYFIT_CLONES
void add_terms(std::size_t terms, const double* a, const double* b, const double* cosines,
               Amplitudes& s) {
  Amplitudes::Batch mu, before, here, sr, si, dr, di, bsr, bsi, bdr, bdi;
  for (int i = 0; i < kBatch; ++i) {
    mu[i] = cosines[i];
    before[i] = 0;
    here[i] = 1;
    sr[i] = si[i] = dr[i] = di[i] = bsr[i] = bsi[i] = bdr[i] = bdi[i] = 0;
  }
  double sign = 1;
  for (std::size_t k = 0; k < terms; ++k) {
    const double n = static_cast<double>(k) + 1, weight = (2 * n + 1) / (n * (n + 1));
    const double sum_r = weight * (a[2 * k] + b[2 * k]),
                 sum_i = weight * (a[2 * k + 1] + b[2 * k + 1]);
    const double difference_r = weight * (a[2 * k] - b[2 * k]),
                 difference_i = weight * (a[2 * k + 1] - b[2 * k + 1]);
    const double turned_sum_r = sign * sum_r, turned_sum_i = sign * sum_i;
    const double turned_difference_r = sign * difference_r,
                 turned_difference_i = sign * difference_i;
    const double up = (2 * n + 1) / n, down = (n + 1) / n;
    for (int i = 0; i < kBatch; ++i) {
      const double tau = n * mu[i] * here[i] - (n + 1) * before[i];
      const double more = here[i] + tau, less = here[i] - tau;
      sr[i] += sum_r * more;
      si[i] += sum_i * more;
      dr[i] += difference_r * less;
      di[i] += difference_i * less;
      bsr[i] += turned_sum_r * less;
      bsi[i] += turned_sum_i * less;
      bdr[i] += turned_difference_r * more;
      bdi[i] += turned_difference_i * more;
      const double next = up * mu[i] * here[i] - down * before[i];
      before[i] = here[i];
      here[i] = next;
    }
    sign = -sign;
  }
  s = {sr, si, dr, di, bsr, bsi, bdr, bdi};
}

Amplitudes amplitudes(const std::vector<Complex>& a, const std::vector<Complex>& b,
                      const double* cosines) {
  Amplitudes s;
  // std::complex is an array of two numbers.
  add_terms(a.size(), reinterpret_cast<const double*>(a.data()),
            reinterpret_cast<const double*>(b.data()), cosines, s);
  return s;
}

}  // namespace

MieCoefficients mie_coefficients(double x, Complex index, bool by_index) {
  if (!(x >= kSmallestSizeParameter && x <= kLargestSizeParameter)) {
    throw std::invalid_argument(fmt::format("size parameter = {:.6g}: expected {} to {}", x,
                                            kSmallestSizeParameter, kLargestSizeParameter));
  }
  if (!(index.real() > 0 && index.imag() >= 0)) {
    throw std::invalid_argument(fmt::format(
        "refractive index = {} + {} i: expected a real part > 0 and an imaginary part >= 0",
        index.real(), index.imag()));
  }
  const int terms = terms_of(x);
  const Complex z = index * x, inverse_index = ratio_of(1, index), inverse_z2 = ratio_of(1, z * z);
  const std::vector<Complex> d = logarithmic_derivatives(z, terms);
  const std::vector<double> psi = riccati_bessel(x, terms), eta = riccati_neumann(x, terms);
  MieCoefficients c;
  for (int k = 1; k <= terms; ++k) {
    const auto n = static_cast<std::size_t>(k);
    const Complex xi(psi[n], eta[n]), xi_before(psi[n - 1], eta[n - 1]);
    const Complex electric = d[n] * inverse_index + k / x, magnetic = index * d[n] + k / x;
    const Complex a_below = electric * xi - xi_before, b_below = magnetic * xi - xi_before;
    c.a.push_back(ratio_of(electric * psi[n] - psi[n - 1], a_below));
    c.b.push_back(ratio_of(magnetic * psi[n] - psi[n - 1], b_below));
    if (!by_index) continue;
    // D' = n (n + 1) / z^2 - 1 - D^2; psi_n eta_{n-1} - psi_{n-1} eta_n = 1.
    const Complex slope = k * (k + 1.0) * inverse_z2 - 1.0 - d[n] * d[n];
    const Complex electric_slope = (slope * x - d[n] * inverse_index) * inverse_index;
    const Complex magnetic_slope = d[n] + slope * z;
    constexpr Complex kI(0, 1);
    c.a_by_index.push_back(ratio_of(-kI * electric_slope, a_below * a_below));
    c.b_by_index.push_back(ratio_of(-kI * magnetic_slope, b_below * b_below));
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

std::vector<MieMatrix> mie_matrix(double x, const MieCoefficients& c,
                                  const std::vector<double>& forward_cosines) {
  const std::size_t count = forward_cosines.size();
  const double unit = 1 / (2 * std::numbers::pi * x * x);
  const bool by_index = !c.a_by_index.empty();
  const std::vector<double> zeros(2 * count);
  std::vector<MieMatrix> result(by_index ? 3 : 1, MieMatrix{zeros, zeros, zeros});
  for (std::size_t begin = 0; begin < count; begin += kBatch) {
    const std::size_t filled = std::min<std::size_t>(kBatch, count - begin);
    Amplitudes::Batch mu{};
    std::copy_n(forward_cosines.begin() + static_cast<std::ptrdiff_t>(begin), filled, mu.begin());
    const Amplitudes s = amplitudes(c.a, c.b, mu.data());
    const Amplitudes slope =
        by_index ? amplitudes(c.a_by_index, c.b_by_index, mu.data()) : Amplitudes{};
    for (std::size_t i = 0; i < 2 * filled; ++i) {
      const bool back = i >= filled;
      const std::size_t place = back ? i - filled : i, at = begin + place + (back ? count : 0);
      const Complex s1 = s.first(place, back), s2 = s.second(place, back);
      result[0].m11[at] = unit * (std::norm(s1) + std::norm(s2));
      result[0].m12[at] = unit * (std::norm(s2) - std::norm(s1));
      result[0].m33[at] = 2 * unit * (s1 * std::conj(s2)).real();
      for (std::size_t part = 1; part < result.size(); ++part) {
        const Complex turn = part == 1 ? Complex(1, 0) : Complex(0, 1);
        const Complex d1 = turn * slope.first(place, back), d2 = turn * slope.second(place, back);
        const double slope_1 = norm_slope(s1, d1), slope_2 = norm_slope(s2, d2);
        result[part].m11[at] = unit * (slope_1 + slope_2);
        result[part].m12[at] = unit * (slope_2 - slope_1);
        result[part].m33[at] = 2 * unit * (d1 * std::conj(s2) + s1 * std::conj(d2)).real();
      }
    }
  }
  return result;
}

}  // namespace skyfit
