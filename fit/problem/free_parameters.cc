// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/free_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace skyfit::fit {
namespace {

bool is_scale(Parameter id) {
  return id == Parameter::kRayleighScattering || id == Parameter::kRayleighScaleHeight ||
         id == Parameter::kMieScattering || id == Parameter::kMieScaleHeight;
}

void move_to_bounds_wavelength(PowerLaw<double>& law) {
  constexpr double kBoundsWavelengthNm = 550;
  law.value *= std::pow(kBoundsWavelengthNm / law.wavelength_nm, -law.exponent);
  law.wavelength_nm = kBoundsWavelengthNm;
}

std::string_view kind_of(const Atmosphere<double>& atmosphere, Parameter id) {
  const bool is_height = id == Parameter::kRayleighScaleHeight || id == Parameter::kMieScaleHeight;
  return is_height ? "a tabulated profile" : phase_kind(atmosphere.mie.phase.type);
}

void require_parameter(const Atmosphere<double>& atmosphere, Parameter id,
                       std::string_view option) {
  if (!has_parameter(atmosphere, id)) {
    throw std::invalid_argument(
        fmt::format("fit.{}: {}: the atmosphere with {} has no such parameter", option,
                    parameter_info(id).name, kind_of(atmosphere, id)));
  }
}

std::optional<Prior> prior_of(const FitOptions& options, const ParameterInfo& info) {
  if (const auto given = options.priors.find(info.id); given != options.priors.end()) {
    return given->second;
  }
  return options.use_priors ? info.prior : std::nullopt;
}

bool is_free(const FitOptions& options, const ParameterInfo& info) {
  if (options.fix.contains(info.id)) return false;
  if (!options.free) return info.free_by_default;
  return std::find(options.free->begin(), options.free->end(), info.id) != options.free->end();
}

void check_names(const FitOptions& options, const SkyModel& model,
                 const Atmosphere<double>& atmosphere) {
  for (const Parameter id : options.free.value_or(std::vector<Parameter>{})) {
    require_parameter(atmosphere, id, "free");
    if (!model.can_fit(id)) {
      throw std::invalid_argument(fmt::format("fit.free: {}: the {} model cannot tell it",
                                              parameter_info(id).name, model.name()));
    }
    if (options.fix.contains(id)) {
      throw std::invalid_argument(
          fmt::format("fit.free: {}: also fixed, must be one of the two", parameter_info(id).name));
    }
  }
  for (const auto& [id, prior] : options.priors) {
    require_parameter(atmosphere, id, "prior");
    if (!is_free(options, parameter_info(id))) {
      throw std::invalid_argument(
          fmt::format("fit.prior: {}: must be free to have a prior", parameter_info(id).name));
    }
  }
}

void check_start(const FreeParameter& parameter, double start) {
  if (start >= parameter.lower && start <= parameter.upper) return;
  const ParameterInfo& info = parameter_info(parameter.id);
  throw std::invalid_argument(
      fmt::format("fit.start: {} = {:.9g} {}: a free parameter must start within {:.9g} .. {:.9g}; "
                  "fix it or start elsewhere",
                  info.name, start, info.unit, parameter.lower, parameter.upper));
}

}  // namespace

Atmosphere<double> with_lobes(const Atmosphere<double>& atmosphere, int lobes) {
  Atmosphere<double> result = atmosphere;
  AerosolPhase<double>& phase = result.mie.phase;
  const bool two = phase.type == PhaseType::kTwoLobe;
  if (lobes == 1 && two) {
    phase.g = phase.weight * phase.g1 + (1 - phase.weight) * phase.g2;
    phase.type = phase.lobe;
  } else if (lobes == 2 && has_parameter(atmosphere, Parameter::kMiePhaseG)) {
    phase.lobe = phase.type;
    phase.g1 = phase.g;
    phase.g2 = std::min(0.2, phase.g - 0.2);
    phase.weight = 0.9;
    phase.type = PhaseType::kTwoLobe;
  }
  return result;
}

Atmosphere<double> start_atmosphere(const FitOptions& options) {
  Atmosphere<double> atmosphere;
  if (options.start) {
    atmosphere = options.start->atmosphere;
    move_to_bounds_wavelength(atmosphere.rayleigh.scattering_per_m);
    move_to_bounds_wavelength(atmosphere.mie.scattering_per_m);
  } else {
    if (options.lobes == 2) atmosphere.mie.phase.type = PhaseType::kTwoLobe;
    for (const ParameterInfo& info : parameter_table()) {
      if (has_parameter(atmosphere, info.id)) {
        set_parameter(atmosphere, info.id, info.default_value);
      }
    }
  }
  if (options.site_pressure_hpa) atmosphere.rayleigh.site_pressure_hpa = *options.site_pressure_hpa;
  return atmosphere;
}

Atmosphere<double> with_fixed_values(const Atmosphere<double>& atmosphere,
                                     const FitOptions& options) {
  Atmosphere<double> result = atmosphere;
  for (const auto& [id, value] : options.fix) {
    require_parameter(atmosphere, id, "fix");
    set_parameter(result, id, value);
  }
  try {
    skyfit::validate(result);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("fit.fix: {}", error.what()));
  }
  return result;
}

FreeParameter free_parameter(Parameter id, const std::optional<Prior>& prior) {
  const ParameterInfo& info = parameter_info(id);
  return {{info.lower, info.upper, is_scale(id) && info.lower > 0, prior}, id};
}

void check_lobes(const FitOptions& options, const SkyModel& model) {
  if (options.lobes > model.lobes()) {
    throw std::invalid_argument(fmt::format("fit.lobes = {}: must be at most {} for the {} model",
                                            options.lobes, model.lobes(), model.name()));
  }
}

std::vector<FreeParameter> choose_free_parameters(const FitOptions& options, const SkyModel& model,
                                                  const Atmosphere<double>& atmosphere) {
  check_names(options, model, atmosphere);
  std::vector<FreeParameter> result;
  for (const ParameterInfo& info : parameter_table()) {
    if (!has_parameter(atmosphere, info.id) || !model.can_fit(info.id) || !is_free(options, info)) {
      continue;
    }
    const FreeParameter parameter = free_parameter(info.id, prior_of(options, info));
    check_start(parameter, get_parameter(atmosphere, info.id));
    result.push_back(parameter);
  }
  if (result.empty()) {
    throw std::invalid_argument("fit.free: nothing is free, at least one parameter must be");
  }
  return result;
}

std::vector<Parameter> ids(const std::vector<FreeParameter>& parameters) {
  std::vector<Parameter> result;
  for (const FreeParameter& parameter : parameters) result.push_back(parameter.id);
  return result;
}

Eigen::VectorXd scaled_values(const std::vector<FreeParameter>& parameters,
                              const Atmosphere<double>& atmosphere) {
  Eigen::VectorXd result(parameters.size());
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const double scaled = parameters[i].scaled(get_parameter(atmosphere, parameters[i].id));
    result(i) = std::clamp(scaled, 0.0, 1.0);
  }
  return result;
}

Atmosphere<double> with_scaled_values(Atmosphere<double> atmosphere,
                                      const std::vector<FreeParameter>& parameters,
                                      const double* scaled) {
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    set_parameter(atmosphere, parameters[i].id, parameters[i].value(scaled[i]));
  }
  return atmosphere;
}

bool lobes_interchangeable(const std::vector<FreeParameter>& parameters) {
  return std::count_if(parameters.begin(), parameters.end(), [](const FreeParameter& parameter) {
           return !parameter.prior && (parameter.id == Parameter::kMiePhaseG1 ||
                                       parameter.id == Parameter::kMiePhaseG2 ||
                                       parameter.id == Parameter::kMiePhaseWeight);
         }) == 3;
}

bool order_lobes(Atmosphere<double>& atmosphere) {
  AerosolPhase<double>& phase = atmosphere.mie.phase;
  if (phase.type != PhaseType::kTwoLobe || phase.g1 >= phase.g2) return false;
  std::swap(phase.g1, phase.g2);
  phase.weight = 1 - phase.weight;
  return true;
}

}  // namespace skyfit::fit
