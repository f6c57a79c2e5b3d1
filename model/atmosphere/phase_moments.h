// SPDX-License-Identifier: Apache-2.0
// A constituent's phase function and its Legendre moments, for any scalar.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "model/atmosphere/constituent.h"
#include "model/shared/shared.h"

namespace skyfit {

// At one wavelength: a table in the place of those by wavelength, particles with their optics.
template <class T>
PhaseFunction<T> phase_at(PhaseFunction<T> phase, double wavelength_nm) {
  if (phase.type == PhaseType::kByWavelength) {
    phase.table = phase.by_wavelength->at(wavelength_nm);
    phase.type = PhaseType::kTabulated;
  } else if (phase.type == PhaseType::kSizeDistribution) {
    phase.optics = optics_at(phase.particles, wavelength_nm);
  }
  return phase;
}

// 1/sr at the cosine nu of the scattering angle; of one that depends_on_wavelength() at one, see
// phase_at().
template <class T>
T phase_value(const PhaseFunction<T>& phase, double nu) {
  Shared<T> shared;
  switch (phase.type) {
    case PhaseType::kTwoLobe:
      return shared.two_lobe_phase(static_cast<int>(phase.lobe), phase.g1, phase.g2, phase.weight,
                                   T(nu));
    case PhaseType::kTabulated:
      return T(phase.table->phase(std::acos(std::clamp(nu, -1.0, 1.0))));
    case PhaseType::kSizeDistribution:
      return with_slopes(phase.optics->phase(std::acos(std::clamp(nu, -1.0, 1.0))),
                         phase.particles);
    case PhaseType::kRayleigh:
      return shared.rayleigh_phase(T(phase.depolarisation), T(nu));
    default:
      return shared.lobe_phase(static_cast<int>(phase.type), phase.g, T(nu));
  }
}

// docs/theory (13.2) and (13.3).
// What it makes of unpolarised light: Q in the frame of the scattering plane, 1/sr, at one
// wavelength. Lobes and tables have no such element: their light counts as unpolarised.
template <class T>
T polarising_phase_value(const PhaseFunction<T>& phase, double nu) {
  if (phase.type == PhaseType::kRayleigh)
    return T(Shared<double>{}.rayleigh_polarising_phase(phase.depolarisation, nu));
  if (phase.type != PhaseType::kSizeDistribution) return T(0.0);
  return with_slopes(phase.optics->polarising_phase(std::acos(std::clamp(nu, -1.0, 1.0))),
                     phase.particles);
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

// docs/theory (2.13).
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
std::vector<T> lobe_moments(PhaseType type, const T& g, int count) {
  return type == PhaseType::kHenyeyGreenstein ? henyey_greenstein_moments(g, count)
                                              : cornette_shanks_moments(g, count);
}

// docs/theory (2.12).
// Of Rayleigh's phase function: chi_0 .. chi_2, the others are 0.
inline std::array<double, 3> rayleigh_moments(double depolarisation) {
  return {1.0, 0.0, Shared<double>{}.rayleigh_second_moment(depolarisation)};
}

// As many as asked for, fewer where the rest is 0. At one wavelength, see phase_at().
template <class T>
std::vector<T> phase_moments(const PhaseFunction<T>& phase, int count) {
  switch (phase.type) {
    case PhaseType::kRayleigh: {
      const std::array<double, 3> chi = rayleigh_moments(phase.depolarisation);
      return std::vector<T>(chi.begin(), chi.begin() + std::min(count, 3));
    }
    case PhaseType::kTabulated: {
      const std::vector<double> chi = phase.table->moments(count);
      return std::vector<T>(chi.begin(), chi.end());
    }
    case PhaseType::kSizeDistribution: {
      std::vector<T> chi;
      for (int l = 0; l < count; ++l)
        chi.push_back(with_slopes(phase.optics->moment(l), phase.particles));
      return chi;
    }
    case PhaseType::kTwoLobe: {
      std::vector<T> chi = lobe_moments(phase.lobe, phase.g1, count);
      const std::vector<T> second = lobe_moments(phase.lobe, phase.g2, count);
      for (int l = 0; l < count; ++l)
        chi[l] = phase.weight * chi[l] + (T(1.0) - phase.weight) * second[l];
      return chi;
    }
    default:
      return lobe_moments(phase.type, phase.g, count);
  }
}

}  // namespace skyfit
