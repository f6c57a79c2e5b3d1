// SPDX-License-Identifier: Apache-2.0
#include "fit/derived.h"

namespace skyfit::fit {
namespace {

double cornette_shanks_mean_cosine(double g) { return g * 3 * (4 + g * g) / (5 * (2 + g * g)); }

}  // namespace

double aerosol_optical_depth(const Atmosphere<double>& atmosphere) {
  const Mie<double>& mie = atmosphere.mie;
  return mie.scattering_per_m.value / mie.single_scattering_albedo * mie.scale_height_m;
}

double rayleigh_optical_depth(const Atmosphere<double>& atmosphere) {
  return atmosphere.rayleigh.scattering_per_m.value * atmosphere.rayleigh.scale_height_m;
}

double aerosol_mean_cosine(const Atmosphere<double>& atmosphere) {
  const AerosolPhase<double>& phase = atmosphere.mie.phase;
  switch (phase.type) {
    case PhaseType::kHenyeyGreenstein:
      return phase.g;
    case PhaseType::kCornetteShanks:
      return cornette_shanks_mean_cosine(phase.g);
    case PhaseType::kTwoLobe:
      break;
  }
  return phase.weight * cornette_shanks_mean_cosine(phase.g1) +
         (1 - phase.weight) * cornette_shanks_mean_cosine(phase.g2);
}

}  // namespace skyfit::fit
