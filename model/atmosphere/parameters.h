// SPDX-License-Identifier: Apache-2.0
// The table of the atmosphere's continuous parameters: one row each, with the one name that report,
// command line and preset use. Everything that lists, fits, bounds or differentiates parameters
// reads this table.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "model/atmosphere/atmosphere.h"

namespace skyfit {

enum class Parameter {
  kRayleighScattering,
  kRayleighScaleHeight,
  kMieScattering,
  kMieAngstromExponent,
  kMieSingleScatteringAlbedo,
  kMieScaleHeight,
  kMiePhaseG,
  kMiePhaseG1,
  kMiePhaseG2,
  kMiePhaseWeight,
  kOzoneColumn,
  kGroundAlbedo,
};
inline constexpr int kParameterCount = 12;

// A weak Gaussian prior that holds what the sky cannot say.
struct Prior {
  double mean, sigma;  // in the parameter's unit
};

struct ParameterInfo {
  Parameter id;
  std::string_view name;  // e.g. "mie.phase.g1"
  std::string_view unit;  // "1/m", "m", "DU" or "1" for a pure number
  double default_value;
  double lower, upper;  // physical bounds of a fit; a preset may lie outside
  std::optional<Prior> prior;
  bool free_by_default;
  std::string_view meaning;  // one line
};

std::span<const ParameterInfo, kParameterCount> parameter_table();
const ParameterInfo& parameter_info(Parameter parameter);

// Throws std::invalid_argument that lists the known names when there is no such parameter.
Parameter parameter_from_name(std::string_view name);

// Whether the atmosphere has the parameter: g only with one lobe; g1, g2 and weight only with two;
// a scale height only of an exponential profile.
bool has_parameter(const Atmosphere<double>& atmosphere, Parameter parameter);

double get_parameter(const Atmosphere<double>& atmosphere, Parameter parameter);
void set_parameter(Atmosphere<double>& atmosphere, Parameter parameter, double value);

}  // namespace skyfit
