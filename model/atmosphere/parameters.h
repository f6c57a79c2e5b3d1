// SPDX-License-Identifier: Apache-2.0
// The continuous parameters of an atmosphere, each with the one name NAME.QUANTITY that report,
// command line and preset use: a quantity of the constituent NAME, or of the ground. Everything
// that lists, fits, bounds or differentiates parameters reads the tables behind parameter_info().
#pragma once

#include <array>
#include <compare>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "model/atmosphere/atmosphere.h"

namespace skyfit {

enum class Quantity {
  kScattering,
  kExtinction,
  kOpticalDepth,
  kColumn,
  kPressure,
  kVolume,
  kAngstromExponent,
  kSingleScatteringAlbedo,
  kScaleHeight,
  kBase,
  kTop,
  kPhaseG,
  kPhaseG1,
  kPhaseG2,
  kPhaseWeight,
  kRadius,
  kWidth,
  kIndexReal,
  kIndexImaginary,
  kAlbedo,  // of the ground alone
};

class Parameter {
 public:
  constexpr Parameter(std::string_view constituent, Quantity quantity) : quantity_(quantity) {
    if (constituent.size() >= name_.size())
      throw std::invalid_argument("a constituent's name is too long");
    for (std::size_t i = 0; i < constituent.size(); ++i) name_[i] = constituent[i];
  }

  constexpr std::string_view constituent() const { return name_.data(); }  // or "ground"
  constexpr Quantity quantity() const { return quantity_; }
  std::string name() const;  // e.g. "mie.phase.g1"

  friend bool operator==(const Parameter&, const Parameter&) = default;
  friend auto operator<=>(const Parameter&, const Parameter&) = default;

  // Those of the standard constituents.
  static const Parameter kRayleighScattering, kRayleighPressure, kRayleighScaleHeight,
      kMieScattering, kMieAngstromExponent, kMieSingleScatteringAlbedo, kMieScaleHeight, kMiePhaseG,
      kMiePhaseG1, kMiePhaseG2, kMiePhaseWeight, kOzoneColumn, kGroundAlbedo;

 private:
  std::array<char, 32> name_{};
  Quantity quantity_;
};

inline constexpr std::string_view kGround = "ground";

inline constexpr Parameter Parameter::kRayleighScattering{"rayleigh", Quantity::kScattering};
inline constexpr Parameter Parameter::kRayleighPressure{"rayleigh", Quantity::kPressure};
inline constexpr Parameter Parameter::kRayleighScaleHeight{"rayleigh", Quantity::kScaleHeight};
inline constexpr Parameter Parameter::kMieScattering{"mie", Quantity::kScattering};
inline constexpr Parameter Parameter::kMieAngstromExponent{"mie", Quantity::kAngstromExponent};
inline constexpr Parameter Parameter::kMieSingleScatteringAlbedo{"mie",
                                                                 Quantity::kSingleScatteringAlbedo};
inline constexpr Parameter Parameter::kMieScaleHeight{"mie", Quantity::kScaleHeight};
inline constexpr Parameter Parameter::kMiePhaseG{"mie", Quantity::kPhaseG};
inline constexpr Parameter Parameter::kMiePhaseG1{"mie", Quantity::kPhaseG1};
inline constexpr Parameter Parameter::kMiePhaseG2{"mie", Quantity::kPhaseG2};
inline constexpr Parameter Parameter::kMiePhaseWeight{"mie", Quantity::kPhaseWeight};
inline constexpr Parameter Parameter::kOzoneColumn{"ozone", Quantity::kColumn};
inline constexpr Parameter Parameter::kGroundAlbedo{kGround, Quantity::kAlbedo};

// A weak Gaussian prior that holds what the sky cannot say.
struct Prior {
  double mean, sigma;  // in the parameter's unit
};

// Between which a fit varies a parameter.
struct Bounds {
  double lower, upper;  // in the parameter's unit
};

struct ParameterInfo {
  std::string name;       // e.g. "mie.phase.g1"
  std::string_view unit;  // "1/m", "m", "um", "DU" or "1" for a pure number
  double lower, upper;    // physical bounds of a fit; a preset may lie outside
  std::optional<Prior> prior;
  bool free_by_default;
  std::string meaning;  // one line
};

// Of the standard constituents a row of their own, of others that of the quantity, without a prior
// and not free by default.
ParameterInfo parameter_info(const Parameter& parameter);

// The same for a fit that starts at this atmosphere. Bounds and priors are those of the Earth:
// where scattering or pressure of the air (rayleigh) lies outside of them, the atmosphere is of
// another planet. There an amount or a length outside of its bounds goes from half to twice its
// value, other bounds reach to it, and the air's priors are about its values, relatively as wide.
ParameterInfo parameter_info(const Parameter& parameter, const Atmosphere<double>& atmosphere);

// Those of the standard constituents and of the ground, whichever of them an atmosphere has.
std::span<const Parameter> standard_parameters();

// Every parameter that the atmosphere has, constituent by constituent, the ground last.
std::vector<Parameter> parameters_of(const Atmosphere<double>& atmosphere);

// By name, of a constituent of any name; throws std::invalid_argument that lists the quantities, or
// for an unknown name of a standard constituent the known names.
Parameter parameter_from_name(std::string_view name);

// Whether the atmosphere has the parameter: a coefficient, an optical depth or a column as its
// constituent states its amount; g only with one lobe; g1, g2 and weight only with two; radius and
// width only of a size distribution, an index only where it does not depend on wavelength; a scale
// height only of an exponential profile, base and top only of a layer (a base only above the
// ground).
bool has_parameter(const Atmosphere<double>& atmosphere, const Parameter& parameter);

// Throws std::invalid_argument that lists the atmosphere's parameters unless it has this one.
void require_parameter(const Atmosphere<double>& atmosphere, const Parameter& parameter);

// Of a parameter that the atmosphere has; throws std::invalid_argument for a constituent that it
// lacks.
double get_parameter(const Atmosphere<double>& atmosphere, const Parameter& parameter);
void set_parameter(Atmosphere<double>& atmosphere, const Parameter& parameter, double value);

}  // namespace skyfit
