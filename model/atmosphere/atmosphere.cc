// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/atmosphere.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <string_view>

namespace skyfit {
namespace {

// Throws unless the value is finite and `holds`; the message names path, value and expectation.
void expect(bool holds, std::string_view path, double value, std::string_view expectation) {
  if (!holds || !std::isfinite(value)) {
    throw std::invalid_argument(fmt::format("{} = {}: expected {}", path, value, expectation));
  }
}

void expect_table(bool present, std::string_view path) {
  if (!present) {
    throw std::invalid_argument(fmt::format("{} = tabulated: expected a table", path));
  }
}

void validate_scale_height(const TabulatedProfile& profile, std::string_view path, double height) {
  expect(profile != nullptr || height > 0.0, path, height, "a height > 0 m");
}

void validate(const PowerLaw<double>& law, const std::string& path) {
  expect(law.wavelength_nm > 0.0, path + ".wavelength_nm", law.wavelength_nm,
         "a wavelength > 0 nm");
  expect(law.value >= 0.0, path + ".value", law.value, "a coefficient >= 0 1/m");
  expect(true, path + ".exponent", law.exponent, "a finite number");
}

void validate_asymmetry(std::string_view path, double g) {
  expect(std::abs(g) < 1.0, path, g, "an asymmetry between -1 and 1, both excluded");
}

void validate(const AerosolPhase<double>& phase) {
  switch (phase.type) {
    case PhaseType::kCornetteShanks:
    case PhaseType::kHenyeyGreenstein:
      validate_asymmetry("mie.phase.g", phase.g);
      return;
    case PhaseType::kTwoLobe:
      validate_asymmetry("mie.phase.g1", phase.g1);
      validate_asymmetry("mie.phase.g2", phase.g2);
      expect(phase.weight >= 0.0 && phase.weight <= 1.0, "mie.phase.weight", phase.weight,
             "a share from 0 to 1");
      return;
    case PhaseType::kTabulated:
      expect_table(phase.table != nullptr, "mie.phase.type");
      return;
  }
}

// Ozone that follows the air needs the air's scale height.
void validate(const Ozone<double>& ozone, bool air_is_exponential) {
  expect(ozone.column_du >= 0.0, "ozone.column_du", ozone.column_du, "a column >= 0 DU");
  if (ozone.profile == OzoneProfile::kTabulated) {
    expect_table(ozone.table != nullptr, "ozone.profile");
  }
  if (ozone.profile == OzoneProfile::kExponential && !air_is_exponential) {
    throw std::invalid_argument(
        "ozone.profile = exponential: expected tent or a table, the air has no scale height");
  }
}

}  // namespace

std::string_view phase_kind(PhaseType type) {
  switch (type) {
    case PhaseType::kTwoLobe:
      return "two lobes";
    case PhaseType::kTabulated:
      return "a tabulated phase function";
    default:
      return "one lobe";
  }
}

void validate(const Atmosphere<double>& atmosphere) {
  const auto& [bottom, top, rayleigh, mie, ozone, albedo, ground_spectrum] = atmosphere;
  expect(bottom > 0.0, "planet.bottom_radius_m", bottom, "a radius > 0 m");
  expect(top > bottom, "planet.top_radius_m", top,
         fmt::format("a radius > bottom_radius_m = {}", bottom));
  validate(rayleigh.scattering_per_m, "rayleigh.scattering_per_m");
  validate_scale_height(rayleigh.profile, "rayleigh.scale_height_m", rayleigh.scale_height_m);
  expect(rayleigh.depolarisation >= 0.0 && rayleigh.depolarisation <= 1.0,
         "rayleigh.depolarisation", rayleigh.depolarisation, "a ratio from 0 to 1");
  expect(rayleigh.site_pressure_hpa > 0.0, "rayleigh.site_pressure_hpa", rayleigh.site_pressure_hpa,
         "a pressure > 0 hPa");
  validate(mie.scattering_per_m, "mie.scattering_per_m");
  const double ssa = mie.single_scattering_albedo;
  expect(ssa > 0.0 && ssa <= 1.0, "mie.single_scattering_albedo", ssa, "a ratio > 0 and <= 1");
  validate_scale_height(mie.profile, "mie.scale_height_m", mie.scale_height_m);
  validate(mie.phase);
  validate(ozone, rayleigh.profile == nullptr);
  expect(albedo >= 0.0 && albedo <= 1.0, "ground.albedo", albedo, "an albedo from 0 to 1");
}

}  // namespace skyfit
