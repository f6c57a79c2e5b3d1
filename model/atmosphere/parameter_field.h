// SPDX-License-Identifier: Apache-2.0
// Where each parameter of the table stands in an Atmosphere of any scalar.
#pragma once

#include <span>
#include <stdexcept>

#include "model/atmosphere/atmosphere.h"
#include "model/atmosphere/parameters.h"
#include "model/numerics/dual.h"

namespace skyfit {

// A is Atmosphere of any scalar, const or not.
template <class A>
auto& parameter_field(A& a, Parameter parameter) {
  switch (parameter) {
    case Parameter::kRayleighScattering:
      return a.rayleigh.scattering_per_m.value;
    case Parameter::kRayleighScaleHeight:
      return a.rayleigh.scale_height_m;
    case Parameter::kMieScattering:
      return a.mie.scattering_per_m.value;
    case Parameter::kMieAngstromExponent:
      return a.mie.scattering_per_m.exponent;
    case Parameter::kMieSingleScatteringAlbedo:
      return a.mie.single_scattering_albedo;
    case Parameter::kMieScaleHeight:
      return a.mie.scale_height_m;
    case Parameter::kMiePhaseG:
      return a.mie.phase.g;
    case Parameter::kMiePhaseG1:
      return a.mie.phase.g1;
    case Parameter::kMiePhaseG2:
      return a.mie.phase.g2;
    case Parameter::kMiePhaseWeight:
      return a.mie.phase.weight;
    case Parameter::kOzoneColumn:
      return a.ozone.column_du;
    case Parameter::kGroundAlbedo:
      return a.ground_albedo;
  }
  throw std::logic_error("parameter_field: unknown parameter");
}

// The atmosphere with derivatives 0, 1, .. seeded by the listed parameters; at most N of them.
template <int N>
Atmosphere<Dual<N>> seeded(const Atmosphere<double>& a, std::span<const Parameter> parameters) {
  Atmosphere<Dual<N>> s;
  s.bottom_radius_m = a.bottom_radius_m;
  s.top_radius_m = a.top_radius_m;
  s.rayleigh = {{a.rayleigh.scattering_per_m.wavelength_nm, a.rayleigh.scattering_per_m.value,
                 a.rayleigh.scattering_per_m.exponent},
                a.rayleigh.scale_height_m,
                a.rayleigh.depolarisation,
                a.rayleigh.site_pressure_hpa,
                a.rayleigh.profile};
  s.mie.scattering_per_m = {a.mie.scattering_per_m.wavelength_nm, a.mie.scattering_per_m.value,
                            a.mie.scattering_per_m.exponent};
  s.mie.single_scattering_albedo = a.mie.single_scattering_albedo;
  s.mie.scale_height_m = a.mie.scale_height_m;
  s.mie.phase = {a.mie.phase.type,   a.mie.phase.g,    a.mie.phase.g1,   a.mie.phase.g2,
                 a.mie.phase.weight, a.mie.phase.lobe, a.mie.phase.table};
  s.mie.profile = a.mie.profile;
  s.ozone = {a.ozone.column_du, a.ozone.profile, a.ozone.table};
  s.ground_albedo = a.ground_albedo;
  s.ground_spectrum = a.ground_spectrum;
  if (parameters.size() > static_cast<std::size_t>(N))
    throw std::logic_error("seeded: too many parameters");
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if constexpr (N > 0) parameter_field(s, parameters[i]).d[i] = 1;
  }
  return s;
}

}  // namespace skyfit
