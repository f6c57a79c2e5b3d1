// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/atmosphere.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>

#include "model/atmosphere/mie.h"
#include "model/atmosphere/validation.h"

namespace skyfit {
namespace {

[[noreturn]] void fail_text(std::string_view path, std::string_view found,
                            std::string_view expectation) {
  throw std::invalid_argument(fmt::format("{} = {}: expected {}", path, found, expectation));
}

// What the solver was tried with, far beyond any sky. Planets: a pebble of 10 km to a giant. On
// smaller ones, and under a top above 1.3 radii, light beyond the terminator came out negative by
// percents of daylight.
constexpr double kLeastRadius = 1e4, kMostRadius = 1e9;  // m
constexpr double kHighestTop = 1.3;                      // bottom radii
constexpr double kThinnest = 100;                        // m, of the whole atmosphere
constexpr double kLeastHeight = 1, kMostHeight = 1e7;    // m, scale heights
constexpr double kMostExponent = 20;
// Backward lobes narrower than that of the least g leave negative light behind when their peak is
// cut off; nothing scatters so.
constexpr double kLeastAsymmetry = -0.8, kMostAsymmetry = 0.999;
constexpr double kLeastWavelength = 1, kMostWavelength = 1e6;       // nm
constexpr double kMostColumn = 1e5;                                 // DU
constexpr double kMostVolume = 1e5;                                 // um^3/um^2
constexpr double kMostPressure = 1e6;                               // hPa
constexpr double kLeastTemperature = 100, kMostTemperature = 1000;  // K
constexpr double kMostCo2 = 1e5;                                    // ppm: of air

void validate_asymmetry(const std::string& path, double g) {
  expect(g >= kLeastAsymmetry && g <= kMostAsymmetry, path, g,
         fmt::format("an asymmetry from {} to {}", kLeastAsymmetry, kMostAsymmetry));
}

void validate(const SizeDistribution<double>& particles, const std::string& path) {
  constexpr double kLeastRadius_um = 1e-3, kMostRadius_um = 200, kLeastWidth = 0.05, kMostWidth = 2;
  constexpr double kShortest = 300;  // nm, at which the largest ones must be within Mie's reach
  if (particles.tables == nullptr) fail_text(path + ".type", "size-distribution", "tables");
  const double radius = particles.radius_um, width = particles.width;
  expect(radius >= kLeastRadius_um && radius <= kMostRadius_um, path + ".median_radius_um", radius,
         fmt::format("a radius from {} to {} um", kLeastRadius_um, kMostRadius_um));
  expect(width >= kLeastWidth && width <= kMostWidth, path + ".width", width,
         fmt::format("a width from {} to {}", kLeastWidth, kMostWidth));
  const double largest = kLargestSizeParameter * 1e-3 * kShortest / (2 * std::numbers::pi);
  expect(largest_radius_um(radius, width) <= largest, path + ".median_radius_um", radius,
         fmt::format("at most {:.4g} um beside a width of {}: spheres up to {:.4g} um can be "
                     "computed",
                     radius * largest / largest_radius_um(radius, width), width, largest));
  if (particles.index_spectrum) return;
  expect(particles.index_real >= kLeastReal && particles.index_real <= kMostIndex,
         path + ".refractive_index.real", particles.index_real, kRealIndex);
  expect(particles.index_imaginary >= 0 && particles.index_imaginary <= kMostIndex,
         path + ".refractive_index.imaginary", particles.index_imaginary, kImaginaryIndex);
  expect(!is_as_air(particles.index_real, particles.index_imaginary),
         path + ".refractive_index.real", particles.index_real, kNotAsAir);
}

void validate(const PhaseFunction<double>& phase, const std::string& path) {
  switch (phase.type) {
    case PhaseType::kCornetteShanks:
    case PhaseType::kHenyeyGreenstein:
      return validate_asymmetry(path + ".g", phase.g);
    case PhaseType::kTwoLobe:
      validate_asymmetry(path + ".g1", phase.g1);
      validate_asymmetry(path + ".g2", phase.g2);
      return expect(phase.weight >= 0.0 && phase.weight <= 1.0, path + ".weight", phase.weight,
                    "a share from 0 to 1");
    case PhaseType::kRayleigh:
      return expect(phase.depolarisation >= 0.0 && phase.depolarisation <= 1.0,
                    path + ".depolarisation", phase.depolarisation, "a ratio from 0 to 1");
    case PhaseType::kTabulated:
      if (phase.table == nullptr) fail_text(path + ".type", "tabulated", "a table");
      return;
    case PhaseType::kSizeDistribution:
      return validate(phase.particles, path);
    case PhaseType::kByWavelength:
      if (phase.by_wavelength == nullptr)
        fail_text(path + ".type", "tabulated-by-wavelength", "tables");
      return;
  }
}

void validate(const Atmosphere<double>& atmosphere, const VerticalProfile<double>& profile,
              const std::string& path) {
  const double top = atmosphere.top_radius_m - atmosphere.bottom_radius_m;
  switch (profile.type) {
    case ProfileType::kExponential:
      return expect(profile.scale_height_m >= kLeastHeight && profile.scale_height_m <= kMostHeight,
                    path + ".scale_height_m", profile.scale_height_m,
                    fmt::format("a height from {} to {} m", kLeastHeight, kMostHeight));
    case ProfileType::kCorners: {
      const CornerProfile& kind = corner_profiles()[profile.corners];
      for (std::size_t i = 0; i < kind.numbers.size(); ++i)
        expect(std::isfinite(profile.numbers[i]), fmt::format("{}.{}", path, kind.numbers[i].field),
               profile.numbers[i], "a finite number");
      if (const auto wrong = kind.problem(profile.numbers))
        expect(false, fmt::format("{}.{}", path, kind.numbers[wrong->number].field),
               profile.numbers[wrong->number], wrong->expected);
      return;
    }
    case ProfileType::kLayer:
      expect(profile.base_m >= 0, path + ".base_m", profile.base_m, "a height >= 0 m");
      expect(profile.top_m >= profile.base_m + kLeastHeight, path + ".top_m", profile.top_m,
             fmt::format("a height >= base_m + {} = {} m", kLeastHeight,
                         profile.base_m + kLeastHeight));
      return expect(profile.top_m * (1 + kLayerEdge) <= top, path + ".top_m", profile.top_m,
                    fmt::format("a height <= {:.9g} m in an atmosphere of {:.9g} m, for its edge",
                                top / (1 + kLayerEdge), top));
    case ProfileType::kTabulated:
      if (profile.table == nullptr) fail_text(path + ".type", "tabulated", "a table");
      return;
    case ProfileType::kSameAs: {
      const Constituent<double>* const other = atmosphere.find(profile.of);
      if (other == nullptr || other->profile.type == ProfileType::kSameAs)
        fail_text(path + ".of", profile.of, "the name of a constituent with a profile of its own");
      return;
    }
    case ProfileType::kSquareOf: {
      const Constituent<double>* const other = atmosphere.find(profile.of);
      if (other == nullptr || other->profile.type != ProfileType::kExponential)
        fail_text(path + ".of", profile.of,
                  "the name of a constituent whose profile is exponential");
    }
  }
}

void validate_pressure(const std::string& path, double pressure_hpa) {
  expect(pressure_hpa >= 0 && pressure_hpa <= kMostPressure, path, pressure_hpa,
         fmt::format("a pressure from 0 to {} hPa", kMostPressure));
}

void validate_amount(const Constituent<double>& c, const std::string& path) {
  const std::string at = path + "." + std::string(amount_path(c.amount_type));
  if (c.amount_type == AmountType::kColumn) {
    return expect(c.amount >= 0 && c.amount <= kMostColumn, at, c.amount,
                  fmt::format("a column from 0 to {} DU", kMostColumn));
  }
  if (c.amount_type == AmountType::kVolume) {
    if (c.phase.type != PhaseType::kSizeDistribution)
      fail_text(path + ".phase.type", phase_kind(c.phase.type),
                "size-distribution beside a volume");
    return expect(c.amount >= 0 && c.amount <= kMostVolume, at, c.amount,
                  fmt::format("a volume from 0 to {} um^3/um^2", kMostVolume));
  }
  if (c.amount_type == AmountType::kAirPressure) {
    expect(c.co2_ppm >= 0 && c.co2_ppm <= kMostCo2, path + ".rayleigh.co2_ppm", c.co2_ppm,
           fmt::format("a share from 0 to {} ppm", kMostCo2));
    return validate_pressure(at, c.amount);
  }
  if (c.amount_type == AmountType::kOxygenPairs) {
    expect(c.temperature_k >= kLeastTemperature && c.temperature_k <= kMostTemperature,
           path + ".oxygen_pairs.temperature_k", c.temperature_k,
           fmt::format("a temperature from {} to {} K", kLeastTemperature, kMostTemperature));
    return validate_pressure(at, c.amount);
  }
  if (c.amount_type == AmountType::kOpticalDepth) {
    expect(c.amount >= 0 && c.amount <= kMostDepth, at, c.amount,
           fmt::format("an optical depth from 0 to {}", kMostDepth));
  } else {
    expect(c.amount >= 0 && c.amount <= kMostCoefficient, at, c.amount,
           fmt::format("a coefficient from 0 to {} 1/m", kMostCoefficient));
  }
  const std::string law = at.substr(0, at.rfind('.'));
  expect(c.wavelength_nm >= kLeastWavelength && c.wavelength_nm <= kMostWavelength,
         law + ".wavelength_nm", c.wavelength_nm,
         fmt::format("a wavelength from {} to {} nm", kLeastWavelength, kMostWavelength));
  expect(std::abs(c.angstrom_exponent) <= kMostExponent, law + ".exponent", c.angstrom_exponent,
         fmt::format("an exponent from -{0} to {0}", kMostExponent));
  if (c.spectrum && !(c.spectrum->at(c.wavelength_nm) > 0))
    fail_text(law + ".spectrum", "0 at wavelength_nm", "a coefficient > 0 there");
}

void validate_albedo(const Constituent<double>& c, const std::string& path) {
  const double ssa = c.single_scattering_albedo;
  const bool scattering = c.amount_type == AmountType::kScattering;
  expect(!is_at_wavelength(c.amount_type) || (ssa <= 1 && (scattering ? ssa > 0 : ssa >= 0)),
         path + ".single_scattering_albedo", ssa,
         scattering ? "a ratio > 0 and <= 1" : "a ratio from 0 to 1");
  if (!scattering || !c.albedo_spectrum) return;
  for (const double value : c.albedo_spectrum->table().y) {
    expect(value > 0, path + ".single_scattering_albedo", value,
           "a ratio > 0, for scattering_per_m is divided by it");
  }
}

// A letter, then letters, digits and underscores; it is the first part of a parameter's name.
void validate_name(const Atmosphere<double>& atmosphere, const std::string& name) {
  constexpr std::size_t kLongest = 24;
  const auto allowed = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  };
  if (name.empty() || name.size() > kLongest || !std::ranges::all_of(name, allowed) ||
      !(name[0] >= 'a' && name[0] <= 'z') || name == "ground") {
    fail_text("constituents.name", "\"" + name + "\"",
              fmt::format("a name of 1 to {} small letters, digits and _ that begins with a letter "
                          "and is not ground",
                          kLongest));
  }
  if (std::ranges::count(atmosphere.constituents, name, &Constituent<double>::name) > 1)
    fail_text("constituents.name", "\"" + name + "\"", "a name that no other constituent has");
}

}  // namespace

void expect(bool holds, std::string_view path, double value, std::string_view expectation) {
  if (!holds || !std::isfinite(value)) {
    throw std::invalid_argument(fmt::format("{} = {}: expected {}", path, value, expectation));
  }
}

std::string_view amount_path(AmountType type) {
  switch (type) {
    case AmountType::kScattering:
      return "scattering_per_m.value";
    case AmountType::kExtinction:
      return "extinction_per_m.value";
    case AmountType::kOpticalDepth:
      return "optical_depth.value";
    case AmountType::kAirPressure:
      return "rayleigh.pressure_hpa";
    case AmountType::kOxygenPairs:
      return "oxygen_pairs.pressure_hpa";
    case AmountType::kVolume:
      return "volume_um3_per_um2";
    case AmountType::kColumn:
      break;
  }
  return "column_du";
}

void fail_without_constituent(std::string_view name) {
  throw std::invalid_argument(fmt::format("the atmosphere has no constituent \"{}\"", name));
}

std::string_view phase_kind(PhaseType type) {
  switch (type) {
    case PhaseType::kTwoLobe:
      return "two lobes";
    case PhaseType::kTabulated:
    case PhaseType::kByWavelength:
      return "a tabulated phase function";
    case PhaseType::kSizeDistribution:
      return "particles of a size distribution";
    case PhaseType::kRayleigh:
      return "Rayleigh's phase function";
    default:
      return "one lobe";
  }
}

void validate(const Atmosphere<double>& atmosphere) {
  const double bottom = atmosphere.bottom_radius_m, top = atmosphere.top_radius_m;
  expect(bottom >= kLeastRadius && bottom <= kMostRadius, "planet.bottom_radius_m", bottom,
         fmt::format("a radius from {} to {} m", kLeastRadius, kMostRadius));
  expect(top >= bottom + kThinnest && top <= kHighestTop * bottom, "planet.top_radius_m", top,
         fmt::format("a radius from bottom_radius_m + {} = {} m to {} times the bottom radius",
                     kThinnest, bottom + kThinnest, kHighestTop));
  if (atmosphere.constituents.size() > kMostConstituents) {
    fail_text("constituents", fmt::format("{} of them", atmosphere.constituents.size()),
              fmt::format("at most {}", kMostConstituents));
  }
  for (const Constituent<double>& c : atmosphere.constituents) {
    validate_name(atmosphere, c.name);
    validate_amount(c, c.name);
    validate_albedo(c, c.name);
    expect(c.site_pressure_hpa > 0 && c.site_pressure_hpa <= kMostPressure,
           c.name + ".site_pressure_hpa", c.site_pressure_hpa,
           fmt::format("a pressure > 0 and <= {} hPa", kMostPressure));
    validate(atmosphere, c.profile, c.name + ".profile");
    if (scatters(c)) validate(c.phase, c.name + ".phase");
  }
  const double albedo = atmosphere.ground_albedo;
  expect(albedo >= 0.0 && albedo <= 1.0, "ground.albedo", albedo, "an albedo from 0 to 1");
  validate(atmosphere.star);
  validate_solver_limits(atmosphere);
}

}  // namespace skyfit
