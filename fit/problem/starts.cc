// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/starts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace skyfit::fit {
namespace {

struct PhaseStart {
  double g, g1, g2, weight;
};

// One lobe: g alone. Two lobes: these four reach the best known minimum of every CIE sky.
constexpr std::array<PhaseStart, 4> kStarts = {{{0.76, 0.78, 0.20, 0.70},
                                                {0.60, 0.90, 0.10, 0.50},
                                                {0.40, 0.80, 0.50, 0.25},
                                                {0.85, 0.85, 0.30, 0.50}}};

// Optical depth 0.2 at 1200 m and single scattering albedo 0.9, the middle of what clear skies ask
// for; from a tenth of it the solver first finds the minima of an air without aerosol.
constexpr double kMieScattering = 1.5e-4;  // 1/m at 550 nm

// R3 sequence (Roberts 2018): n / plastic^k modulo 1, with the root of x^4 = x + 1.
PhaseStart phase_start(int n) {
  if (n < static_cast<int>(kStarts.size())) return kStarts[n];
  constexpr double kRoot = 1.2207440846057596;
  const auto part = [n](int k) {
    const double value = 0.5 + n / std::pow(kRoot, k);
    return value - std::floor(value);
  };
  const double g1 = 0.6 + 0.35 * part(1);
  return {0.2 + 0.7 * part(1), g1, std::min(-0.1 + 0.7 * part(2), g1 - 0.1), 0.15 + 0.7 * part(3)};
}

double value_of(const PhaseStart& start, const Parameter& id) {
  switch (id.quantity()) {
    case Quantity::kPhaseG:
      return start.g;
    case Quantity::kPhaseG1:
      return start.g1;
    case Quantity::kPhaseG2:
      return start.g2;
    case Quantity::kScattering:
      return kMieScattering;
    default:
      return start.weight;
  }
}

bool is_phase(const FreeParameter& parameter) {
  switch (parameter.id.quantity()) {
    case Quantity::kPhaseG:
    case Quantity::kPhaseG1:
    case Quantity::kPhaseG2:
    case Quantity::kPhaseWeight:
      return true;
    default:
      return false;
  }
}

// What the starts set: the phase parameters, and with them the amount of aerosol; or that alone,
// where nothing else is free.
std::vector<FreeParameter> varied_parameters(const std::vector<FreeParameter>& parameters) {
  std::vector<FreeParameter> result;
  const bool nothing_else =
      parameters.size() == 1 && parameters.front().id == Parameter::kMieScattering;
  if (!nothing_else && std::none_of(parameters.begin(), parameters.end(), is_phase)) return result;
  for (const FreeParameter& parameter : parameters) {
    if (is_phase(parameter) || parameter.id == Parameter::kMieScattering) {
      result.push_back(parameter);
    }
  }
  return result;
}

Start named(const Atmosphere<double>& atmosphere, const std::vector<FreeParameter>& varied) {
  std::string name;
  for (const FreeParameter& parameter : varied) {
    std::string short_name = parameter.id.name();
    short_name.erase(0, short_name.rfind('.') + 1);
    name += fmt::format("{}{} {:.3g}", name.empty() ? "" : ", ", short_name,
                        get_parameter(atmosphere, parameter.id));
  }
  return {name.empty() ? "as given" : name, atmosphere};
}

}  // namespace

std::vector<Start> choose_starts(const Atmosphere<double>& atmosphere,
                                 const std::vector<FreeParameter>& parameters, int count,
                                 bool own_first) {
  const std::vector<FreeParameter> varied = varied_parameters(parameters);
  std::vector<Start> result;
  if (own_first || varied.empty()) result.push_back(named(atmosphere, varied));
  if (varied.size() == 1 && varied.front().id == Parameter::kMieScattering) {
    count = 1;  // the starts differ in the phase parameters
  }
  for (int n = 0; !varied.empty() && static_cast<int>(result.size()) < count; ++n) {
    Atmosphere<double> start = atmosphere;
    for (const FreeParameter& parameter : varied) {
      set_parameter(
          start, parameter.id,
          std::clamp(value_of(phase_start(n), parameter.id), parameter.lower, parameter.upper));
    }
    result.push_back(named(start, varied));
  }
  return result;
}

}  // namespace skyfit::fit
