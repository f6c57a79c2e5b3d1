// SPDX-License-Identifier: Apache-2.0
#include "fit/result/derived.h"

#include <cmath>

#include "model/atmosphere/phase_moments.h"
#include "model/atmosphere/profile.h"

namespace skyfit::fit {

double aerosol_optical_depth(const Atmosphere<double>& atmosphere) {
  const Mie<double>& mie = atmosphere.mie;
  return mie.scattering_per_m.value / mie.single_scattering_albedo *
         profiles_of(atmosphere).aerosol.vertical_column().value;
}

double rayleigh_optical_depth(const Atmosphere<double>& atmosphere) {
  const Rayleigh<double>& air = atmosphere.rayleigh;
  return air.scattering_per_m.value * air.site_pressure_hpa / kStandardPressureHpa *
         profiles_of(atmosphere).air.vertical_column().value;
}

double aerosol_mean_cosine(const Atmosphere<double>& atmosphere) {
  return aerosol_phase_moments(atmosphere.mie.phase, 2)[1];
}

double standard_pressure_hpa(double elevation_m) {
  return kStandardPressureHpa * std::pow(1 - 2.25577e-5 * elevation_m, 5.25588);
}

}  // namespace skyfit::fit
