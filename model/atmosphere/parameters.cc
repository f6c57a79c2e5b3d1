// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>
#include <string>

#include "model/atmosphere/parameter_field.h"

namespace skyfit {
namespace {

using enum Parameter;

// Priors hold what the shape of a sky's luminance cannot say; they are weak against what it can.
// - Rayleigh scattering and scale height follow from the surface pressure and temperature: 5 %
// covers sites to about
//   500 m, 500 m of scale height covers -15 .. +20 C around the mean of the troposphere.
// - The sky fixes the aerosol's optical depth, not its height: 1200 +- 500 m spans the mixed layers
// of a day.
// - Single scattering albedo: 0.92 +- 0.05 spans urban, smoke and dust aerosols (AERONET: Dubovik
// et al. 2002, 0.86-0.97).
// - Ground albedo: 0.15 +- 0.05 spans grass, soil, towns and water in visible light, without snow.
constexpr std::array<ParameterInfo, kParameterCount> kTable = {{
    {kRayleighScattering, "rayleigh.scattering", "1/m", 1.216e-5, 0.5 * 1.216e-5, 2.0 * 1.216e-5,
     Prior{1.216e-5, 0.05 * 1.216e-5}, true,
     "scattering coefficient of air at h = 0 and its wavelength"},
    {kRayleighScaleHeight, "rayleigh.scale_height", "m", 8000.0, 5000.0, 12000.0,
     Prior{8000.0, 500.0}, true, "height over which the density of air falls by e"},
    {kMieScattering, "mie.scattering", "1/m", 2.2e-5, 1e-7, 2e-3, std::nullopt, true,
     "scattering coefficient of aerosol at h = 0 and its wavelength"},
    {kMieAngstromExponent, "mie.angstrom_exponent", "1", 1.3, -0.5, 2.5, std::nullopt, false,
     "aerosol scattering goes as wavelength to the minus this"},
    {kMieSingleScatteringAlbedo, "mie.single_scattering_albedo", "1", 0.9, 0.6, 1.0,
     Prior{0.92, 0.05}, true, "scattering over extinction of aerosol"},
    {kMieScaleHeight, "mie.scale_height", "m", 1200.0, 300.0, 5000.0, Prior{1200.0, 500.0}, true,
     "height over which the density of aerosol falls by e"},
    {kMiePhaseG, "mie.phase.g", "1", 0.76, -0.6, 0.98, std::nullopt, true,
     "asymmetry parameter of a phase function of one lobe"},
    {kMiePhaseG1, "mie.phase.g1", "1", 0.8, -0.6, 0.98, std::nullopt, true,
     "asymmetry parameter of the narrower of two lobes"},
    {kMiePhaseG2, "mie.phase.g2", "1", 0.3, -0.6, 0.98, std::nullopt, true,
     "asymmetry parameter of the wider of two lobes"},
    {kMiePhaseWeight, "mie.phase.weight", "1", 0.5, 0.0, 1.0, std::nullopt, true,
     "share of the lobe g1"},
    {kOzoneColumn, "ozone.column", "DU", 300.0, 0.0, 600.0, std::nullopt, false,
     "vertical column of ozone"},
    {kGroundAlbedo, "ground.albedo", "1", 0.1, 0.0, 1.0, Prior{0.15, 0.05}, true,
     "Lambertian albedo of the ground"},
}};

}  // namespace

std::span<const ParameterInfo, kParameterCount> parameter_table() { return kTable; }

const ParameterInfo& parameter_info(Parameter parameter) {
  return kTable.at(static_cast<std::size_t>(parameter));
}

Parameter parameter_from_name(std::string_view name) {
  std::vector<std::string_view> known;
  for (const ParameterInfo& info : kTable) {
    if (info.name == name) return info.id;
    known.push_back(info.name);
  }
  throw std::invalid_argument(
      fmt::format("{}: unknown parameter, expected one of {}", name, fmt::join(known, ", ")));
}

bool has_parameter(const Atmosphere<double>& atmosphere, Parameter parameter) {
  const PhaseType phase = atmosphere.mie.phase.type;
  switch (parameter) {
    case kRayleighScaleHeight:
      return atmosphere.rayleigh.profile == nullptr;
    case kMieScaleHeight:
      return atmosphere.mie.profile == nullptr;
    case kMiePhaseG:
      return phase == PhaseType::kCornetteShanks || phase == PhaseType::kHenyeyGreenstein;
    case kMiePhaseG1:
    case kMiePhaseG2:
    case kMiePhaseWeight:
      return phase == PhaseType::kTwoLobe;
    default:
      return true;
  }
}

double get_parameter(const Atmosphere<double>& atmosphere, Parameter parameter) {
  return parameter_field(atmosphere, parameter);
}

void set_parameter(Atmosphere<double>& atmosphere, Parameter parameter, double value) {
  parameter_field(atmosphere, parameter) = value;
}

}  // namespace skyfit
