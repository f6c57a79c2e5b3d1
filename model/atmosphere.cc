// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere.h"

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
  if (phase.type != PhaseType::kTwoLobe) {
    validate_asymmetry("mie.phase.g", phase.g);
    return;
  }
  validate_asymmetry("mie.phase.g1", phase.g1);
  validate_asymmetry("mie.phase.g2", phase.g2);
  expect(phase.weight >= 0.0 && phase.weight <= 1.0, "mie.phase.weight", phase.weight,
         "a share from 0 to 1");
}

}  // namespace

void validate(const Atmosphere<double>& atmosphere) {
  const auto& [bottom, top, rayleigh, mie, ozone, albedo] = atmosphere;
  expect(bottom > 0.0, "planet.bottom_radius_m", bottom, "a radius > 0 m");
  expect(top > bottom, "planet.top_radius_m", top,
         fmt::format("a radius > bottom_radius_m = {}", bottom));
  validate(rayleigh.scattering_per_m, "rayleigh.scattering_per_m");
  expect(rayleigh.scale_height_m > 0.0, "rayleigh.scale_height_m", rayleigh.scale_height_m,
         "a height > 0 m");
  validate(mie.scattering_per_m, "mie.scattering_per_m");
  const double ssa = mie.single_scattering_albedo;
  expect(ssa > 0.0 && ssa <= 1.0, "mie.single_scattering_albedo", ssa, "a ratio > 0 and <= 1");
  expect(mie.scale_height_m > 0.0, "mie.scale_height_m", mie.scale_height_m, "a height > 0 m");
  validate(mie.phase);
  expect(ozone.column_du >= 0.0, "ozone.column_du", ozone.column_du, "a column >= 0 DU");
  expect(albedo >= 0.0 && albedo <= 1.0, "ground.albedo", albedo, "an albedo from 0 to 1");
}

}  // namespace skyfit
