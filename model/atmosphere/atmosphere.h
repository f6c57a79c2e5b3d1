// SPDX-License-Identifier: Apache-2.0
// The atmosphere that skyfit fits: a spherical planet under layers of air and aerosol, exponential
// or from a table, and a layer of ozone. Lengths in metres, coefficients in 1/m, wavelengths in nm.
// Height h is measured from the bottom radius; densities are relative to h = 0: rho(h) = exp(-h /
// H) when exponential. Source: Bruneton & Neyret 2008, section 2, with the aerosol's wavelength
// dependence of Angstrom and an ozone layer.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "model/atmosphere/ground_spectrum.h"
#include "model/atmosphere/linear_profile.h"
#include "model/atmosphere/tabulated_phase.h"

namespace skyfit {

enum class PhaseType { kCornetteShanks, kHenyeyGreenstein, kTwoLobe, kTabulated };
enum class OzoneProfile {
  kTent,         // 0 at 10 km, 1 at 25 km, 0 at 40 km
  kExponential,  // with the scale height of the air
  kTabulated
};
inline constexpr double kStandardPressureHpa = 1013.25;

// A species' profile from a table; null: exponential, with the species' scale height.
using TabulatedProfile = std::shared_ptr<const LinearProfile>;

// Scattering coefficient at h = 0: value * (lambda / wavelength)^-exponent.
template <class T>
struct PowerLaw {
  double wavelength_nm = 550;
  T value{};     // 1/m at wavelength_nm
  T exponent{};  // > 0: bluer is stronger
  bool operator==(const PowerLaw&) const = default;
};

template <class T>
struct Rayleigh {
  PowerLaw<T> scattering_per_m{550, T(1.216e-5), T(4.08)};
  T scale_height_m{8000.0};
  double depolarisation = 0;  // of natural light scattered at a right angle; 0.0279 for dry air
  // At h = 0; the coefficient is that of the standard pressure and goes as the pressure.
  double site_pressure_hpa = kStandardPressureHpa;
  TabulatedProfile profile = nullptr;
  bool operator==(const Rayleigh&) const = default;
};

// The aerosol's phase function; all forms integrate to 1 over the sphere, g > 0 scatters forward.
// kTwoLobe: weight P(g1) + (1 - weight) P(g2) with P of the type `lobe`.
template <class T>
struct AerosolPhase {
  PhaseType type = PhaseType::kCornetteShanks;
  T g{0.76};                                              // one lobe only
  T g1{0.8}, g2{0.3}, weight{0.5};                        // two lobes only; weight is that of g1
  PhaseType lobe = PhaseType::kCornetteShanks;            // or kHenyeyGreenstein
  std::shared_ptr<const TabulatedPhase> table = nullptr;  // kTabulated only
  bool operator==(const AerosolPhase&) const = default;
};

template <class T>
struct Mie {
  PowerLaw<T> scattering_per_m{550, T(2.2e-5), T(1.3)};
  T single_scattering_albedo{0.9};  // scattering / extinction
  T scale_height_m{1200.0};
  AerosolPhase<T> phase;
  TabulatedProfile profile = nullptr;
  bool operator==(const Mie&) const = default;
};

template <class T>
struct Ozone {
  T column_du{300.0};  // vertical column, Dobson units; 1 DU = 2.687e20 molecules / m^2
  OzoneProfile profile = OzoneProfile::kTent;
  TabulatedProfile table = nullptr;  // kTabulated only; its column is column_du
  bool operator==(const Ozone&) const = default;
};

template <class T>
struct Atmosphere {
  double bottom_radius_m = 6360e3;
  double top_radius_m = 6460e3;
  Rayleigh<T> rayleigh;
  Mie<T> mie;
  Ozone<T> ozone;
  T ground_albedo{0.1};                                             // Lambertian, at 550 nm
  std::shared_ptr<const GroundSpectrum> ground_spectrum = nullptr;  // null: grey
  bool operator==(const Atmosphere&) const = default;
};

// "one lobe", "two lobes" or "a tabulated phase function".
std::string_view phase_kind(PhaseType type);

// Throws std::invalid_argument with one line that names the preset path, the value and what was
// expected, when a parameter is not finite or not physical (negative coefficient, albedo outside
// 0..1, |g| >= 1, top <= bottom ...).
void validate(const Atmosphere<double>& atmosphere);

}  // namespace skyfit
