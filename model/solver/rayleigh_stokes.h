// SPDX-License-Identifier: Apache-2.0
// The azimuth modes of Rayleigh's phase matrix. Its part of second degree has rank 1 in every mode:
// light of the Stokes components (I, Q, U)_m is scattered into (i, q, u)_m(mu) chi_2 K_m with
//   K_m = 2 pi integral (i I + q Q + u U)_m dmu,
//   I, Q = sum_m (2 - delta_m0) (I_m, Q_m) cos m phi, U = sum_m 2 U_m sin m phi,
// mu and phi those of the direction in which one looks, phi = azimuth of the view less that of the
// sun, counter-clockwise from above. Q > 0: polarised along the meridian plane of the view; U > 0:
// along up and to the right as the observer sees it (docs/theory, chapter 13).
#pragma once

#include <cmath>
#include <numbers>

namespace skyfit {

struct StokesFunctions {
  double i = 0, q = 0, u = 0;  // i is Lambda_2m of docs/theory (4.2)
};

inline constexpr int kPolarisedModes = 3;

enum class Stokes { kI, kQ, kU };
inline double component(const StokesFunctions& f, Stokes which) {
  return which == Stokes::kI ? f.i : which == Stokes::kQ ? f.q : f.u;
}

// docs/theory (13.5); 0 for modes above 2, which air does not have. sr^-1/2.
inline StokesFunctions rayleigh_stokes(int m, double mu) {
  const double sine2 = std::fmax(1 - mu * mu, 0.0), sine = std::sqrt(sine2);
  switch (m) {
    case 0: {
      const double factor = std::sqrt(5 / (4 * std::numbers::pi));
      return {factor * (1.5 * mu * mu - 0.5), -factor * 1.5 * sine2, 0};
    }
    case 1: {
      const double factor = std::sqrt(15 / (8 * std::numbers::pi));
      return {factor * mu * sine, factor * mu * sine, -factor * sine};
    }
    case 2: {
      const double factor = std::sqrt(15 / (32 * std::numbers::pi));
      return {factor * sine2, -factor * (1 + mu * mu), factor * 2 * mu};
    }
    default:
      return {};
  }
}

}  // namespace skyfit
