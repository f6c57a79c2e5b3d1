// SPDX-License-Identifier: Apache-2.0
// Where each parameter of the table stands in an Atmosphere of any scalar.
#pragma once

#include <span>
#include <stdexcept>

#include "model/atmosphere/atmosphere.h"
#include "model/atmosphere/parameters.h"
#include "model/numerics/dual.h"

namespace skyfit {

// Derivatives that the solver carries at once; more are taken in turns.
inline constexpr int kDerivativesAtOnce = 12;

// A is Atmosphere of any scalar, const or not. Throws std::invalid_argument for a constituent that
// it lacks.
template <class A>
auto& parameter_field(A& a, const Parameter& parameter) {
  if (parameter.quantity() == Quantity::kAlbedo) return a.ground_albedo;
  auto& c = a.at(parameter.constituent());
  switch (parameter.quantity()) {
    case Quantity::kScattering:
    case Quantity::kExtinction:
    case Quantity::kOpticalDepth:
    case Quantity::kColumn:
    case Quantity::kPressure:
    case Quantity::kVolume:
      return c.amount;
    case Quantity::kAngstromExponent:
      return c.angstrom_exponent;
    case Quantity::kSingleScatteringAlbedo:
      return c.single_scattering_albedo;
    case Quantity::kScaleHeight:
      return c.profile.scale_height_m;
    case Quantity::kBase:
      return c.profile.base_m;
    case Quantity::kTop:
      return c.profile.top_m;
    case Quantity::kPhaseG:
      return c.phase.g;
    case Quantity::kPhaseG1:
      return c.phase.g1;
    case Quantity::kPhaseG2:
      return c.phase.g2;
    case Quantity::kPhaseWeight:
      return c.phase.weight;
    case Quantity::kRadius:
      return c.phase.particles.radius_um;
    case Quantity::kWidth:
      return c.phase.particles.width;
    case Quantity::kIndexReal:
      return c.phase.particles.index_real;
    case Quantity::kIndexImaginary:
      return c.phase.particles.index_imaginary;
    case Quantity::kAlbedo:
      break;
  }
  throw std::logic_error("parameter_field: unknown parameter");
}

// The same constituent of another scalar, its derivatives 0.
template <class T>
Constituent<T> with_scalar(const Constituent<double>& c) {
  Constituent<T> s;
  s.name = c.name;
  s.amount_type = c.amount_type;
  s.amount = T(c.amount);
  s.wavelength_nm = c.wavelength_nm;
  s.angstrom_exponent = T(c.angstrom_exponent);
  s.spectrum = c.spectrum;
  s.site_pressure_hpa = c.site_pressure_hpa;
  s.absorber = c.absorber;
  s.temperature_k = c.temperature_k;
  s.co2_ppm = c.co2_ppm;
  s.single_scattering_albedo = T(c.single_scattering_albedo);
  s.albedo_spectrum = c.albedo_spectrum;
  s.profile = {
      c.profile.type,    T(c.profile.scale_height_m), T(c.profile.base_m), T(c.profile.top_m),
      c.profile.corners, c.profile.numbers,           c.profile.table,     c.profile.of};
  s.phase = {c.phase.type,           T(c.phase.g),
             T(c.phase.g1),          T(c.phase.g2),
             T(c.phase.weight),      c.phase.lobe,
             c.phase.depolarisation, c.phase.table,
             c.phase.by_wavelength,  with_scalar<T>(c.phase.particles)};
  return s;
}

// The atmosphere with derivatives 0, 1, .. seeded by the listed parameters; at most N of them.
template <int N>
Atmosphere<Dual<N>> seeded(const Atmosphere<double>& a, std::span<const Parameter> parameters) {
  Atmosphere<Dual<N>> s;
  s.bottom_radius_m = a.bottom_radius_m;
  s.top_radius_m = a.top_radius_m;
  s.constituents.clear();
  for (const Constituent<double>& c : a.constituents)
    s.constituents.push_back(with_scalar<Dual<N>>(c));
  s.ground_albedo = a.ground_albedo;
  s.ground_spectrum = a.ground_spectrum;
  s.sea = a.sea;
  s.star = a.star;
  if (parameters.size() > static_cast<std::size_t>(N))
    throw std::logic_error("seeded: too many parameters");
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if constexpr (N > 0) parameter_field(s, parameters[i]).d[i] = 1;
  }
  return s;
}

}  // namespace skyfit
