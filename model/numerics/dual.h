// SPDX-License-Identifier: Apache-2.0
// A value and its derivatives by N parameters (forward mode). The model uses it for its scalars;
// fields are differentiated by hand. N = 0 is a plain double in disguise.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <type_traits>

namespace skyfit {

// In the place of an array of none, which would take as much room as a number.
struct NoDerivatives {
  double& operator[](std::size_t) { throw std::logic_error("Dual<0> has no derivatives"); }
  double operator[](std::size_t) const { throw std::logic_error("Dual<0> has no derivatives"); }
};

template <int N>
struct Dual {
  double v = 0;
  [[no_unique_address]] std::conditional_t<N == 0, NoDerivatives, std::array<double, N>> d{};

  Dual() = default;
  Dual(double value) : v(value) {}  // NOLINT: a constant is a dual number with zero derivatives
  static Dual variable(double value, int index) {
    Dual r(value);
    r.d[static_cast<std::size_t>(index)] = 1;
    return r;
  }

  // f(v) with slope df/dv.
  Dual chain(double value, double slope) const {
    Dual r(value);
    for (std::size_t i = 0; i < N; ++i) r.d[i] = slope * d[i];
    return r;
  }

  Dual operator-() const { return chain(-v, -1); }
  Dual& operator+=(const Dual& o) {
    v += o.v;
    for (std::size_t i = 0; i < N; ++i) d[i] += o.d[i];
    return *this;
  }
  Dual& operator-=(const Dual& o) {
    v -= o.v;
    for (std::size_t i = 0; i < N; ++i) d[i] -= o.d[i];
    return *this;
  }
  Dual& operator*=(const Dual& o) {
    for (std::size_t i = 0; i < N; ++i) d[i] = d[i] * o.v + v * o.d[i];
    v *= o.v;
    return *this;
  }
  Dual& operator/=(const Dual& o) {
    const double inverse = 1 / o.v;
    v *= inverse;
    for (std::size_t i = 0; i < N; ++i) d[i] = (d[i] - v * o.d[i]) * inverse;
    return *this;
  }
  friend Dual operator+(Dual a, const Dual& b) { return a += b; }
  friend Dual operator-(Dual a, const Dual& b) { return a -= b; }
  friend Dual operator*(Dual a, const Dual& b) { return a *= b; }
  friend Dual operator/(Dual a, const Dual& b) { return a /= b; }
  friend Dual operator*(double a, const Dual& b) { return b.chain(a * b.v, a); }
  friend Dual operator*(const Dual& b, double a) { return b.chain(a * b.v, a); }
  friend bool operator<(const Dual& a, const Dual& b) { return a.v < b.v; }
  friend bool operator>(const Dual& a, const Dual& b) { return a.v > b.v; }

  friend Dual exp(const Dual& a) {
    const double e = std::exp(a.v);
    return a.chain(e, e);
  }
  friend Dual sqrt(const Dual& a) {
    const double s = std::sqrt(a.v);
    return a.chain(s, 0.5 / s);
  }
};

static_assert(sizeof(Dual<0>) == sizeof(double));

inline double value_of(double x) { return x; }
template <int N>
double value_of(const Dual<N>& x) {
  return x.v;
}

}  // namespace skyfit
