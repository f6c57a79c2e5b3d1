// SPDX-License-Identifier: Apache-2.0
// The aerosol's phase function and its Legendre moments, for any scalar.
#pragma once

#include <array>
#include <vector>

#include "model/atmosphere.h"
#include "model/shared/shared.h"

namespace skyfit {

// 1/sr at the cosine nu of the scattering angle.
template <class T>
T aerosol_phase(const AerosolPhase<T>& phase, double nu) {
  Shared<T> shared;
  switch (phase.type) {
    case PhaseType::kCornetteShanks:
      return shared.cornette_shanks_phase(phase.g, T(nu));
    case PhaseType::kHenyeyGreenstein:
      return shared.henyey_greenstein_phase(phase.g, T(nu));
    case PhaseType::kTwoLobe:
      return shared.two_lobe_phase(phase.g1, phase.g2, phase.weight, T(nu));
  }
  return T(0.0);
}

// Moments chi_l, l = 0 .. count - 1: P(nu) = sum_l (2 l + 1) / (4 pi) chi_l P_l(nu), chi_0 = 1.

template <class T>
std::vector<T> henyey_greenstein_moments(const T& g, int count) {
  std::vector<T> chi(count, T(1.0));
  for (int l = 1; l < count; ++l) chi[l] = chi[l - 1] * g;
  return chi;
}

// Moments of nu f(nu) from those of f, one fewer: (2 l + 1) nu P_l = (l + 1) P_{l+1} + l P_{l-1}.
template <class T>
std::vector<T> moments_times_cosine(const std::vector<T>& chi) {
  std::vector<T> r(chi.size() - 1, T(0.0));
  for (std::size_t l = 0; l < r.size(); ++l) {
    const double n = static_cast<double>(l);
    r[l] = chi[l + 1] * ((n + 1) / (2 * n + 1));
    if (l > 0) r[l] += chi[l - 1] * (n / (2 * n + 1));
  }
  return r;
}

// Cornette-Shanks is Henyey-Greenstein times 3/2 (1 + nu^2) / (2 + g^2).
template <class T>
std::vector<T> cornette_shanks_moments(const T& g, int count) {
  std::vector<T> chi = henyey_greenstein_moments(g, count + 2);
  const std::vector<T> squared = moments_times_cosine(moments_times_cosine(chi));
  const T scale = T(1.5) / (T(2.0) + g * g);
  chi.resize(count);
  for (int l = 0; l < count; ++l) chi[l] = scale * (chi[l] + squared[l]);
  return chi;
}

template <class T>
std::vector<T> aerosol_phase_moments(const AerosolPhase<T>& phase, int count) {
  switch (phase.type) {
    case PhaseType::kCornetteShanks:
      return cornette_shanks_moments(phase.g, count);
    case PhaseType::kHenyeyGreenstein:
      return henyey_greenstein_moments(phase.g, count);
    case PhaseType::kTwoLobe:
      break;
  }
  std::vector<T> chi = cornette_shanks_moments(phase.g1, count);
  const std::vector<T> second = cornette_shanks_moments(phase.g2, count);
  for (int l = 0; l < count; ++l)
    chi[l] = phase.weight * chi[l] + (T(1.0) - phase.weight) * second[l];
  return chi;
}

// Of the air: chi_0 .. chi_2, the others are 0.
inline std::array<double, 3> rayleigh_moments(double depolarisation) {
  return {1.0, 0.0, Shared<double>{}.rayleigh_second_moment(depolarisation)};
}

}  // namespace skyfit
