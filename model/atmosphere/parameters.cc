// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "model/atmosphere/parameter_field.h"

namespace skyfit {
namespace {

using enum Quantity;

struct Row {
  Quantity quantity;
  std::string_view name, unit;
  double lower, upper;
  std::string_view meaning;
};

// Of a constituent of any name; "NAME" in a meaning stands for it. Bounds are those of particles
// that exist: none of an ensemble scatters mostly backward (g >= 0, where lobes of small particles
// end at Rayleigh's symmetry), and over a column none absorbs more than 30 % of what it takes out
// of a beam (Dubovik et al. 2002: 0.86 to 0.98; fresh smoke and towns reach 0.75).
constexpr std::array<Row, 20> kQuantities = {{
    {kScattering, "scattering", "1/m", 1e-9, 0.1,
     "scattering coefficient of NAME where its density is 1, at its wavelength"},
    {kExtinction, "extinction", "1/m", 1e-9, 0.1,
     "extinction coefficient of NAME where its density is 1, at its wavelength"},
    {kOpticalDepth, "optical_depth", "1", 1e-5, 100.0,
     "vertical optical depth of NAME at its wavelength"},
    {kColumn, "column", "DU", 0.0, 600.0, "vertical column of NAME"},
    {kPressure, "pressure", "hPa", 1.0, 2000.0,
     "pressure at the ground that NAME's amount follows"},
    {kVolume, "volume", "um", 1e-6, 100.0,
     "volume of the particles of NAME above an area, um^3/um^2"},
    {kAngstromExponent, "angstrom_exponent", "1", -4.5, 4.5,
     "NAME's coefficients go as wavelength to the minus this"},
    {kSingleScatteringAlbedo, "single_scattering_albedo", "1", 0.7, 1.0,
     "scattering over extinction of NAME"},
    {kScaleHeight, "scale_height", "m", 100.0, 20000.0,
     "height over which the density of NAME falls by e"},
    {kBase, "base_m", "m", 1.0, 20000.0, "height at which the layer of NAME begins"},
    {kTop, "top_m", "m", 100.0, 30000.0, "height at which the layer of NAME ends"},
    {kPhaseG, "phase.g", "1", 0.0, 0.98, "asymmetry parameter of NAME's one lobe"},
    {kPhaseG1, "phase.g1", "1", 0.0, 0.98, "asymmetry parameter of NAME's narrower lobe"},
    {kPhaseG2, "phase.g2", "1", 0.0, 0.98, "asymmetry parameter of NAME's wider lobe"},
    {kPhaseWeight, "phase.weight", "1", 0.0, 1.0, "share of NAME's lobe g1"},
    {kRadius, "radius", "um", 0.01, 30.0, "median radius of the volume of NAME's particles"},
    {kWidth, "width", "1", 0.15, 1.0, "standard deviation of the logarithm of NAME's radii"},
    {kIndexReal, "index.real", "1", 1.3, 2.0, "real part of the refractive index of NAME"},
    {kIndexImaginary, "index.imaginary", "1", 0.0, 0.8,
     "imaginary part of the refractive index of NAME, which absorbs"},
    {kAlbedo, "albedo", "1", 0.0, 1.0, "Lambertian albedo of the ground"},
}};

const Row& row_of(Quantity quantity) {
  return *std::ranges::find(kQuantities, quantity, &Row::quantity);
}

// What is known better of the standard constituents.
struct StandardRow {
  Parameter parameter;
  double lower, upper;
  std::optional<Prior> prior;
  bool free_by_default;
  std::string_view meaning;
};

// Priors hold what the shape of a sky's luminance cannot say; they are weak against what it can.
// - Rayleigh scattering and scale height follow from the surface pressure and temperature: 5 %
//   covers sites to about 500 m, 500 m of scale height covers -15 .. +20 C around the mean of the
//   troposphere. Where the pressure itself is the unknown, it is that of the site to 0.5 %: a
//   barometer and the formulas of dry_air.h leave 0.1 % each open, gravity 0.3 %. Fits of measured
//   skies take the share for the pressure that they know (fit/problem/options.h).
// - The sky fixes the aerosol's optical depth, not its height: 1200 +- 500 m spans the mixed layers
//   of a day.
// - Single scattering albedo: 0.92 +- 0.05 spans urban, smoke and dust aerosols (AERONET: Dubovik
//   et al. 2002, 0.86-0.97).
// - Ground albedo: 0.15 +- 0.05 spans grass, soil, towns and water in visible light, without snow.
constexpr std::array<StandardRow, 13> kStandard = {{
    {Parameter::kRayleighScattering, 0.5 * 1.216e-5, 2.0 * 1.216e-5,
     Prior{1.216e-5, 0.05 * 1.216e-5}, true,
     "scattering coefficient of air at h = 0 and its wavelength"},
    {Parameter::kRayleighPressure, 200.0, 1100.0,
     Prior{kStandardPressureHpa, 0.005 * kStandardPressureHpa}, true,
     "pressure of the air at the ground, which its scattering follows"},
    {Parameter::kRayleighScaleHeight, 5000.0, 12000.0, Prior{8000.0, 500.0}, true,
     "height over which the density of air falls by e"},
    {Parameter::kMieScattering, 1e-7, 2e-3, std::nullopt, true,
     "scattering coefficient of aerosol at h = 0 and its wavelength"},
    {Parameter::kMieAngstromExponent, -0.5, 2.5, std::nullopt, false,
     "aerosol scattering goes as wavelength to the minus this"},
    {Parameter::kMieSingleScatteringAlbedo, 0.7, 1.0, Prior{0.92, 0.05}, true,
     "scattering over extinction of aerosol"},
    {Parameter::kMieScaleHeight, 300.0, 5000.0, Prior{1200.0, 500.0}, true,
     "height over which the density of aerosol falls by e"},
    {Parameter::kMiePhaseG, 0.0, 0.98, std::nullopt, true,
     "asymmetry parameter of a phase function of one lobe"},
    {Parameter::kMiePhaseG1, 0.0, 0.98, std::nullopt, true,
     "asymmetry parameter of the narrower of two lobes"},
    {Parameter::kMiePhaseG2, 0.0, 0.98, std::nullopt, true,
     "asymmetry parameter of the wider of two lobes"},
    {Parameter::kMiePhaseWeight, 0.0, 1.0, std::nullopt, true, "share of the lobe g1"},
    {Parameter::kOzoneColumn, 0.0, 600.0, std::nullopt, false, "vertical column of ozone"},
    {Parameter::kGroundAlbedo, 0.0, 1.0, Prior{0.15, 0.05}, true,
     "Lambertian albedo of the ground"},
}};

bool states_amount(const Constituent<double>& c, Quantity quantity) {
  switch (c.amount_type) {
    case AmountType::kScattering:
      return quantity == kScattering;
    case AmountType::kExtinction:
      return quantity == kExtinction;
    case AmountType::kOpticalDepth:
      return quantity == kOpticalDepth;
    case AmountType::kColumn:
      return quantity == kColumn;
    case AmountType::kAirPressure:
    case AmountType::kOxygenPairs:
      return quantity == kPressure;
    case AmountType::kVolume:
      return quantity == kVolume;
  }
  return false;
}

bool has_quantity(const Constituent<double>& c, Quantity quantity) {
  const PhaseType phase = c.phase.type;
  const bool particles = phase == PhaseType::kSizeDistribution;
  switch (quantity) {
    case kScattering:
    case kExtinction:
    case kOpticalDepth:
    case kColumn:
    case kPressure:
    case kVolume:
      return states_amount(c, quantity);
    case kAngstromExponent:
      return is_at_wavelength(c.amount_type) && !c.spectrum && !particles &&
             phase != PhaseType::kRayleigh;
    case kSingleScatteringAlbedo:
      return scatters(c) && !c.albedo_spectrum && !particles && phase != PhaseType::kRayleigh;
    case kScaleHeight:
      return c.profile.type == ProfileType::kExponential;
    case kBase:
      return c.profile.type == ProfileType::kLayer && c.profile.base_m > 0;
    case kTop:
      return c.profile.type == ProfileType::kLayer;
    case kPhaseG:
      return scatters(c) &&
             (phase == PhaseType::kCornetteShanks || phase == PhaseType::kHenyeyGreenstein);
    case kPhaseG1:
    case kPhaseG2:
    case kPhaseWeight:
      return scatters(c) && phase == PhaseType::kTwoLobe;
    case kRadius:
    case kWidth:
      return particles;
    case kIndexReal:
    case kIndexImaginary:
      return particles && !c.phase.particles.index_spectrum;
    case kAlbedo:
      return false;
  }
  return false;
}

std::string with_name(std::string_view meaning, std::string_view name) {
  std::string text(meaning);
  const std::size_t at = text.find("NAME");
  return at == text.npos ? text : text.replace(at, 4, name);
}

// By its air, of which the Earth's is known.
bool is_of_another_planet(const Atmosphere<double>& atmosphere) {
  return std::ranges::any_of(
      std::array{Parameter::kRayleighScattering, Parameter::kRayleighPressure},
      [&](const Parameter& id) {
        if (!has_parameter(atmosphere, id)) return false;
        const ParameterInfo info = parameter_info(id);
        const double value = get_parameter(atmosphere, id);
        return value < info.lower || value > info.upper;
      });
}

}  // namespace

std::string Parameter::name() const {
  return fmt::format("{}.{}", constituent(), row_of(quantity_).name);
}

ParameterInfo parameter_info(const Parameter& parameter) {
  const Row& row = row_of(parameter.quantity());
  const auto standard = std::ranges::find(kStandard, parameter, &StandardRow::parameter);
  if (standard != kStandard.end()) {
    return {parameter.name(),
            row.unit,
            standard->lower,
            standard->upper,
            standard->prior,
            standard->free_by_default,
            std::string(standard->meaning)};
  }
  return {parameter.name(),
          row.unit,
          row.lower,
          row.upper,
          {},
          false,
          with_name(row.meaning, parameter.constituent())};
}

ParameterInfo parameter_info(const Parameter& parameter, const Atmosphere<double>& atmosphere) {
  ParameterInfo info = parameter_info(parameter);
  if (!is_of_another_planet(atmosphere)) return info;
  const double value = get_parameter(atmosphere, parameter);
  if (info.prior && parameter.constituent() == Parameter::kRayleighScattering.constituent())
    info.prior = Prior{value, value * info.prior->sigma / info.prior->mean};
  if (value >= info.lower && value <= info.upper) return info;
  constexpr std::array kPureNumbers = {
      kAngstromExponent, kSingleScatteringAlbedo, kPhaseG, kPhaseG1, kPhaseG2, kPhaseWeight, kWidth,
      kIndexReal,        kIndexImaginary,         kAlbedo};
  if (std::ranges::count(kPureNumbers, parameter.quantity()) > 0 || !(value > 0)) {
    info.lower = std::min(info.lower, value);
    info.upper = std::max(info.upper, value);
  } else {
    info.lower = 0.5 * value;
    info.upper = 2 * value;
  }
  return info;
}

std::span<const Parameter> standard_parameters() {
  static const std::vector<Parameter> kAll = [] {
    std::vector<Parameter> all;
    for (const StandardRow& row : kStandard) all.push_back(row.parameter);
    return all;
  }();
  return kAll;
}

std::vector<Parameter> parameters_of(const Atmosphere<double>& atmosphere) {
  std::vector<Parameter> parameters;
  for (const Constituent<double>& c : atmosphere.constituents) {
    for (const Row& row : kQuantities) {
      if (has_quantity(c, row.quantity)) parameters.emplace_back(c.name, row.quantity);
    }
  }
  parameters.push_back(Parameter::kGroundAlbedo);
  return parameters;
}

Parameter parameter_from_name(std::string_view name) {
  std::vector<std::string> known;
  const std::size_t dot = name.find('.');
  const std::string_view constituent = name.substr(0, dot);
  bool standard = false;
  for (const Parameter& parameter : standard_parameters()) {
    known.push_back(parameter.name());
    if (known.back() == name) return parameter;
    standard |= parameter.constituent() == constituent;
  }
  const std::string_view quantity = dot == name.npos ? "" : name.substr(dot + 1);
  const auto row = std::ranges::find(kQuantities, quantity, &Row::name);
  if (row != kQuantities.end() && row->quantity != kAlbedo && constituent != kGround &&
      constituent.size() < 32 && !constituent.empty())
    return {constituent, row->quantity};
  if (standard || dot == name.npos) {
    throw std::invalid_argument(
        fmt::format("{}: unknown parameter, expected one of {}", name, fmt::join(known, ", ")));
  }
  std::vector<std::string_view> quantities;
  for (const Row& each : kQuantities) {
    if (each.quantity != kAlbedo) quantities.push_back(each.name);
  }
  throw std::invalid_argument(
      fmt::format("{}: unknown parameter, expected a constituent's name, a "
                  "dot and one of {}",
                  name, fmt::join(quantities, ", ")));
}

bool has_parameter(const Atmosphere<double>& atmosphere, const Parameter& parameter) {
  if (parameter == Parameter::kGroundAlbedo) return true;
  const Constituent<double>* const c = atmosphere.find(parameter.constituent());
  return c != nullptr && has_quantity(*c, parameter.quantity());
}

void require_parameter(const Atmosphere<double>& atmosphere, const Parameter& parameter) {
  if (has_parameter(atmosphere, parameter)) return;
  std::vector<std::string> known;
  for (const Parameter& each : parameters_of(atmosphere)) known.push_back(each.name());
  throw std::invalid_argument(
      fmt::format("{}: the atmosphere has no such parameter, expected one "
                  "of {}",
                  parameter.name(), fmt::join(known, ", ")));
}

double get_parameter(const Atmosphere<double>& atmosphere, const Parameter& parameter) {
  return parameter_field(atmosphere, parameter);
}

void set_parameter(Atmosphere<double>& atmosphere, const Parameter& parameter, double value) {
  parameter_field(atmosphere, parameter) = value;
}

}  // namespace skyfit
