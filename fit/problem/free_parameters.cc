// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/free_parameters.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "model/atmosphere/derived.h"

namespace skyfit::fit {
namespace {

bool is_scale(const Parameter& id) {
  switch (id.quantity()) {
    case Quantity::kScattering:
    case Quantity::kExtinction:
    case Quantity::kOpticalDepth:
    case Quantity::kScaleHeight:
    case Quantity::kVolume:
    case Quantity::kRadius:
      return true;
    default:
      return false;
  }
}

void move_to_bounds_wavelength(Constituent<double>& c) {
  constexpr double kBoundsWavelengthNm = 550;
  if (!is_at_wavelength(c.amount_type) || c.spectrum ||
      c.phase.type == PhaseType::kSizeDistribution)
    return;
  c.amount *= std::pow(kBoundsWavelengthNm / c.wavelength_nm, -c.angstrom_exponent);
  c.wavelength_nm = kBoundsWavelengthNm;
}

void require_parameter_of(const Atmosphere<double>& atmosphere, const Parameter& id,
                          std::string_view option) {
  try {
    require_parameter(atmosphere, id);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("fit.{}: {}", option, error.what()));
  }
}

std::optional<Prior> prior_of(const FitOptions& options, const Parameter& id,
                              const Atmosphere<double>& atmosphere) {
  if (const auto given = options.priors.find(id); given != options.priors.end()) {
    return given->second;
  }
  return options.use_priors ? parameter_info(id, atmosphere).prior : std::nullopt;
}

bool is_free(const FitOptions& options, const Parameter& id) {
  if (options.fix.contains(id)) return false;
  if (!options.free) return parameter_info(id).free_by_default;
  return std::find(options.free->begin(), options.free->end(), id) != options.free->end();
}

void require_free(const FitOptions& options, const Atmosphere<double>& atmosphere,
                  const Parameter& id, std::string_view option, std::string_view what) {
  require_parameter_of(atmosphere, id, option);
  if (is_free(options, id)) return;
  throw std::invalid_argument(
      fmt::format("fit.{}: {}: must be free to have {}", option, id.name(), what));
}

void check_names(const FitOptions& options, const SkyModel& model,
                 const Atmosphere<double>& atmosphere) {
  for (const Parameter id : options.free.value_or(std::vector<Parameter>{})) {
    require_parameter_of(atmosphere, id, "free");
    if (!model.can_fit(id)) {
      throw std::invalid_argument(
          fmt::format("fit.free: {}: the {} model cannot tell it", id.name(), model.name()));
    }
    if (options.fix.contains(id)) {
      throw std::invalid_argument(
          fmt::format("fit.free: {}: also fixed, must be one of the two", id.name()));
    }
  }
  for (const auto& [id, prior] : options.priors)
    require_free(options, atmosphere, id, "prior", "a prior");
  for (const auto& [id, bounds] : options.bounds)
    require_free(options, atmosphere, id, "bounds", "bounds");
}

void check_start(const FreeParameter& parameter, double start) {
  if (start >= parameter.lower && start <= parameter.upper) return;
  const ParameterInfo info = parameter_info(parameter.id);
  throw std::invalid_argument(
      fmt::format("fit.start: {} = {:.9g} {}: a free parameter must start within {:.9g} .. {:.9g}; "
                  "fix it or start elsewhere",
                  info.name, start, info.unit, parameter.lower, parameter.upper));
}

}  // namespace

Atmosphere<double> with_lobes(const Atmosphere<double>& atmosphere, int lobes) {
  Atmosphere<double> result = atmosphere;
  const Constituent<double>* const aerosol = main_aerosol(result);
  if (aerosol == nullptr) return result;
  PhaseFunction<double>& phase = result.at(aerosol->name).phase;
  const bool two = phase.type == PhaseType::kTwoLobe;
  if (lobes == 1 && two) {
    phase.g = phase.weight * phase.g1 + (1 - phase.weight) * phase.g2;
    phase.type = phase.lobe;
  } else if (lobes == 2 && has_parameter(atmosphere, {aerosol->name, Quantity::kPhaseG})) {
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
    std::ranges::for_each(atmosphere.constituents, move_to_bounds_wavelength);
  } else if (options.lobes == 2) {
    atmosphere.at("mie").phase.type = PhaseType::kTwoLobe;
  }
  return atmosphere;
}

Atmosphere<double> with_fixed_values(const Atmosphere<double>& atmosphere,
                                     const FitOptions& options) {
  Atmosphere<double> result = atmosphere;
  for (const auto& [id, value] : options.fix) {
    require_parameter_of(atmosphere, id, "fix");
    set_parameter(result, id, value);
  }
  try {
    skyfit::validate(result);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("fit.fix: {}", error.what()));
  }
  return result;
}

bool is_logarithmic(const Parameter& id, double lower) { return is_scale(id) && lower > 0; }

FreeParameter free_parameter(Parameter id, const ParameterInfo& info,
                             const std::optional<Prior>& prior) {
  return {{info.lower, info.upper, is_logarithmic(id, info.lower), prior}, id};
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
  for (const Parameter& id : parameters_of(atmosphere)) {
    if (!model.can_fit(id) || !is_free(options, id)) continue;
    FreeParameter parameter =
        free_parameter(id, parameter_info(id, atmosphere), prior_of(options, id, atmosphere));
    if (const auto given = options.bounds.find(id); given != options.bounds.end()) {
      std::tie(parameter.lower, parameter.upper) =
          std::pair(given->second.lower, given->second.upper);
      parameter.logarithmic = is_logarithmic(id, parameter.lower);
    }
    check_start(parameter, get_parameter(atmosphere, id));
    result.push_back(parameter);
  }
  if (result.empty() && !(options.free && options.free->empty())) {
    throw std::invalid_argument("fit.free: nothing is free, at least one parameter must be");
  }
  return result;
}

bool is_of_two_lobes(const Parameter& id) {
  const Quantity quantity = id.quantity();
  return quantity == Quantity::kPhaseG1 || quantity == Quantity::kPhaseG2 ||
         quantity == Quantity::kPhaseWeight;
}

bool lobes_interchangeable(const std::vector<FreeParameter>& parameters) {
  return std::count_if(parameters.begin(), parameters.end(), [](const FreeParameter& parameter) {
           return !parameter.prior && is_of_two_lobes(parameter.id);
         }) == 3;
}

bool order_lobes(Atmosphere<double>& atmosphere) {
  const Constituent<double>* const aerosol = main_aerosol(atmosphere);
  if (aerosol == nullptr) return false;
  PhaseFunction<double>& phase = atmosphere.at(aerosol->name).phase;
  if (phase.type != PhaseType::kTwoLobe || phase.g1 >= phase.g2) return false;
  std::swap(phase.g1, phase.g2);
  phase.weight = 1 - phase.weight;
  return true;
}

}  // namespace skyfit::fit
