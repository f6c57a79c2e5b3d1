// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/derived.h"

#include <algorithm>
#include <cmath>

#include "model/atmosphere/optics.h"
#include "model/atmosphere/parameter_field.h"
#include "model/atmosphere/phase_moments.h"
#include "model/atmosphere/profile.h"

namespace skyfit {
namespace {

constexpr double kGreen = 550;  // nm

enum class ScattererKind { kMolecules, kAerosol, kCloud };

bool is_molecular(const Constituent<double>& c) { return c.phase.type == PhaseType::kRayleigh; }

bool is_scatterer(const Constituent<double>& c, ScattererKind kind) {
  if (!scatters(c)) return false;
  if (is_molecular(c)) return kind == ScattererKind::kMolecules;
  return kind == (c.name.starts_with("cloud") ? ScattererKind::kCloud : ScattererKind::kAerosol);
}

double depth_of(const Atmosphere<double>& atmosphere, ScattererKind kind) {
  double sum = 0;
  for (const Constituent<double>& c : atmosphere.constituents) {
    if (is_scatterer(c, kind)) sum += vertical_optical_depth(atmosphere, c, {kGreen, 0});
  }
  return sum;
}

}  // namespace

double vertical_optical_depth(const Atmosphere<double>& atmosphere,
                              const Constituent<double>& constituent, const WavelengthNode& node) {
  const double column = Profile(own_profile(atmosphere, constituent)).vertical_column().value;
  return coefficients_at<0>(with_scalar<Dual<0>>(constituent), Dual<0>(column), node).extinction.v *
         column;
}

double aerosol_optical_depth(const Atmosphere<double>& atmosphere) {
  return depth_of(atmosphere, ScattererKind::kAerosol);
}

double rayleigh_optical_depth(const Atmosphere<double>& atmosphere) {
  return depth_of(atmosphere, ScattererKind::kMolecules);
}

double cloud_optical_depth(const Atmosphere<double>& atmosphere) {
  return depth_of(atmosphere, ScattererKind::kCloud);
}

const Constituent<double>* main_aerosol(const Atmosphere<double>& atmosphere) {
  const Constituent<double>* first = nullptr;
  for (const Constituent<double>& c : atmosphere.constituents) {
    if (!is_scatterer(c, ScattererKind::kAerosol)) continue;
    if (c.name == "mie") return &c;
    if (first == nullptr) first = &c;
  }
  return first;
}

const Constituent<double>* main_cloud(const Atmosphere<double>& atmosphere) {
  const auto found = std::ranges::find_if(
      atmosphere.constituents,
      [](const Constituent<double>& c) { return is_scatterer(c, ScattererKind::kCloud); });
  return found == atmosphere.constituents.end() ? nullptr : &*found;
}

double mean_cosine(const PhaseFunction<double>& phase) {
  return phase_moments(phase_at(phase, kGreen), 2)[1];
}

double single_scattering_albedo(const Constituent<double>& constituent) {
  return single_scattering_albedo_at(with_scalar<Dual<0>>(constituent), kGreen).v;
}

double angstrom_exponent(const Constituent<double>& constituent) {
  if (constituent.phase.type != PhaseType::kSizeDistribution) return constituent.angstrom_exponent;
  constexpr double kBlue = 440, kRed = 675;  // nm
  const SizeDistribution<double>& particles = constituent.phase.particles;
  return std::log(optics_at(particles, kBlue)->scattering[0] /
                  optics_at(particles, kRed)->scattering[0]) /
         std::log(kRed / kBlue);
}

double aerosol_mean_cosine(const Atmosphere<double>& atmosphere) {
  const Constituent<double>* const aerosol = main_aerosol(atmosphere);
  return aerosol == nullptr ? 0 : mean_cosine(aerosol->phase);
}

std::string_view aerosol_kind(const Atmosphere<double>& atmosphere) {
  const Constituent<double>* const aerosol = main_aerosol(atmosphere);
  return aerosol == nullptr ? "no aerosol" : phase_kind(aerosol->phase.type);
}

double standard_pressure_hpa(double elevation_m) {
  return kStandardPressureHpa * std::pow(1 - 2.25577e-5 * elevation_m, 5.25588);
}

void set_site_pressure(Atmosphere<double>& atmosphere, double pressure_hpa) {
  for (Constituent<double>& c : atmosphere.constituents) {
    if (c.amount_type == AmountType::kAirPressure || c.amount_type == AmountType::kOxygenPairs) {
      c.amount = pressure_hpa;
    } else if (is_molecular(c)) {
      c.site_pressure_hpa = pressure_hpa;
    }
  }
}

}  // namespace skyfit
