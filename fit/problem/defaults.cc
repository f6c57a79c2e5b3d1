// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/defaults.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <ranges>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "fit/problem/starts.h"
#include "model/atmosphere/derived.h"

namespace skyfit::fit {
namespace {

// The aureole within 10 deg of the sun, which a pointing error of a degree changes by a tenth,
// would otherwise draw the forward lobe to its bound. 0.88 +- 0.05 spans the forward lobes that
// describe fine and coarse aerosol together.
constexpr Prior kForwardLobePrior{0.88, 0.05};

constexpr double kGreen = 550;  // nm

// The amount of a constituent as its vertical optical depth at 550 nm.
void set_optical_depth(Constituent<double>& c, double optical_depth) {
  c.amount = optical_depth;
  c.amount_type = AmountType::kOpticalDepth;
  c.wavelength_nm = kGreen;
}

// The aerosol with its amount as an optical depth, and the values that are known as its start.
Atmosphere<double> with_known_aerosol(Atmosphere<double> atmosphere,
                                      const refs::AerosolKnowledge& known) {
  const Constituent<double>* const aerosol = main_aerosol(atmosphere);
  if (aerosol == nullptr || !is_at_wavelength(aerosol->amount_type) || aerosol->spectrum ||
      aerosol->phase.type == PhaseType::kSizeDistribution)
    throw std::invalid_argument(
        "fit.start: expected an aerosol whose amount goes as a power of wavelength, of which "
        "AERONET's products can be priors");
  Constituent<double>& c = atmosphere.at(aerosol->name);
  const auto within = [&](Quantity quantity, double value) {
    const ParameterInfo info = parameter_info({c.name, quantity});
    return std::clamp(value, info.lower, info.upper);
  };
  if (known.optical_depth)
    set_optical_depth(c, within(Quantity::kOpticalDepth, known.optical_depth->mean));
  if (known.angstrom_exponent)
    c.angstrom_exponent = within(Quantity::kAngstromExponent, known.angstrom_exponent->mean);
  if (known.single_scattering_albedo && !c.albedo_spectrum) {
    c.single_scattering_albedo =
        within(Quantity::kSingleScatteringAlbedo, known.single_scattering_albedo->mean);
  }
  return atmosphere;
}

std::map<Parameter, Prior> priors_of(const refs::AerosolKnowledge& known,
                                     const Atmosphere<double>& atmosphere) {
  const std::string name = main_aerosol(atmosphere)->name;
  std::map<Parameter, Prior> priors;
  const auto add = [&](Quantity quantity, const std::optional<Prior>& prior) {
    const Parameter id{name, quantity};
    if (prior && has_parameter(atmosphere, id)) priors.emplace(id, *prior);
  };
  add(Quantity::kOpticalDepth, known.optical_depth);
  add(Quantity::kAngstromExponent, known.angstrom_exponent);
  add(Quantity::kSingleScatteringAlbedo, known.single_scattering_albedo);
  return priors;
}

// What irradiances tell, which have no directions: the aerosol's amount; and from two of beam, sky
// and both its single scattering albedo.
std::set<Quantity> told_by_irradiances(const refs::Reference& reference) {
  std::set<Irradiance> kinds;
  for (const refs::Sample& sample : reference.samples) {
    if (sample.weight == 0 || !sample.irradiance) continue;
    kinds.insert(*sample.irradiance == kDirectHorizontal ? kDirectNormal : *sample.irradiance);
  }
  std::set<Quantity> told = {Quantity::kOpticalDepth, Quantity::kScattering, Quantity::kExtinction,
                             Quantity::kVolume};
  if (kinds.size() > 1) told.insert(Quantity::kSingleScatteringAlbedo);
  return told;
}

// Of the site, when every scan states the same, but for those of irradiances beside a sky alone.
std::optional<double> common_elevation(const refs::Reference& reference) {
  std::set<std::size_t> of_irradiances;
  for (const refs::Sample& sample : reference.samples) {
    if (refs::is_beside_sky(reference, sample))
      of_irradiances.insert(static_cast<std::size_t>(sample.scan));
  }
  for (const refs::Sample& sample : reference.samples) {
    if (!refs::is_beside_sky(reference, sample))
      of_irradiances.erase(static_cast<std::size_t>(sample.scan));
  }
  std::optional<double> elevation;
  for (std::size_t s = 0; s < reference.scans.size(); ++s) {
    if (of_irradiances.contains(s)) continue;
    const refs::Scan& scan = reference.scans[s];
    if (!scan.elevation_m || (elevation && *elevation != *scan.elevation_m)) return {};
    elevation = scan.elevation_m;
  }
  return elevation;
}

// Stated, or without a preset that of the elevation.
std::optional<double> site_pressure(const refs::Reference& reference, const FitOptions& options) {
  if (options.site_pressure_hpa || options.start) return options.site_pressure_hpa;
  if (const auto elevation = common_elevation(reference)) return standard_pressure_hpa(*elevation);
  return {};
}

Atmosphere<double> with_gases_of_measured_skies(Atmosphere<double> atmosphere) {
  atmosphere.at("rayleigh") = standard_air<double>();
  atmosphere.constituents.push_back(standard_oxygen_pairs<double>());
  atmosphere.constituents.push_back(standard_nitrogen_dioxide<double>());
  return atmosphere;
}

}  // namespace

FitOptions with_free_of_irradiances(FitOptions options, const refs::Reference& reference,
                                    const SkyModel& model, const Atmosphere<double>& atmosphere) {
  const Constituent<double>* const aerosol = main_aerosol(atmosphere);
  if (options.free || !refs::is_irradiance(reference.quantity) || aerosol == nullptr)
    return options;
  const std::set<Quantity> told = told_by_irradiances(reference);
  options.free.emplace();
  for (const Parameter& id : parameters_of(atmosphere)) {
    const bool of_aerosol =
        told.contains(id.quantity()) && id == Parameter{aerosol->name, id.quantity()};
    if ((of_aerosol || options.priors.contains(id)) && model.can_fit(id) &&
        !options.fix.contains(id))
      options.free->push_back(id);
  }
  return options;
}

FitOptions with_default_parameters(const FitOptions& options, const SkyModel& model,
                                   bool several_wavelengths, bool pointing_is_unknown,
                                   const Atmosphere<double>& atmosphere) {
  FitOptions result = options;
  const auto is_free = [&](const Parameter& id) {
    return options.free
               ? std::ranges::count(*options.free, id) > 0
               : has_parameter(atmosphere, id) && model.can_fit(id) && !options.fix.contains(id);
  };
  if (options.use_priors && pointing_is_unknown && is_free(Parameter::kMiePhaseG1))
    result.priors.emplace(Parameter::kMiePhaseG1, kForwardLobePrior);
  if (options.use_priors && is_free(Parameter::kRayleighPressure) &&
      has_parameter(atmosphere, Parameter::kRayleighPressure)) {
    const double pressure = get_parameter(atmosphere, Parameter::kRayleighPressure);
    const Prior standard = *parameter_info(Parameter::kRayleighPressure).prior;
    result.priors.emplace(Parameter::kRayleighPressure,
                          Prior{pressure, pressure * standard.sigma / standard.mean});
  }
  if (options.aerosol) {
    for (const auto& [id, prior] : priors_of(*options.aerosol, atmosphere)) {
      if (options.free ? !is_free(id) : options.fix.contains(id)) continue;
      if (!model.can_fit(id))
        throw std::invalid_argument(
            fmt::format("AERONET tells {0}, which the {1} model does not fit: expected --fix "
                        "{0}=VALUE beside it",
                        id.name(), model.name()));
      result.priors.emplace(id, prior);
    }
  }
  if (options.free || (!several_wavelengths && !options.aerosol)) return result;
  result.free.emplace();
  for (const Parameter& id : parameters_of(atmosphere)) {
    const bool free = parameter_info(id).free_by_default ||
                      (several_wavelengths && id == Parameter::kMieAngstromExponent) ||
                      result.priors.contains(id);
    if (free && model.can_fit(id) && !options.fix.contains(id)) result.free->push_back(id);
  }
  return result;
}

Atmosphere<double> given_atmosphere(const refs::Reference& reference, const FitOptions& options) {
  Atmosphere<double> given = start_atmosphere(options);
  if (!options.start && reference.quantity != refs::Quantity::kRelativeLuminance)
    given = with_gases_of_measured_skies(given);
  if (!options.start && refs::is_irradiance(reference.quantity))
    set_optical_depth(given.at("mie"), aerosol_optical_depth(given));
  if (const auto pressure = site_pressure(reference, options)) set_site_pressure(given, *pressure);
  if (options.ground) given.ground_spectrum = *options.ground;
  if (options.aerosol) given = with_known_aerosol(std::move(given), *options.aerosol);
  return given;
}

std::vector<std::string> assumptions(const refs::Reference& reference, const FitOptions& options) {
  std::vector<std::string> notes;
  if (options.aerosol) notes = options.aerosol->notes;
  if (options.start || reference.quantity == refs::Quantity::kRelativeLuminance ||
      site_pressure(reference, options))
    return notes;
  notes.push_back(
      fmt::format("the elevation of the site is not stated: its air has the pressure of the "
                  "sea's level, {} hPa, by default (elevation_m, --site-pressure-hpa)",
                  kStandardPressureHpa));
  return notes;
}

std::optional<std::string> repeated_samples(const Dataset& data) {
  std::set<std::tuple<double, double, double, int, double, int>> known;
  std::size_t repeated = 0;
  for (const Sample& sample : data.samples) {
    if (sample.irradiance) continue;
    const SkyPoint& at = data.views[static_cast<std::size_t>(sample.view)].stated;
    const int kind = sample.polarisation ? 1 + static_cast<int>(*sample.polarisation) : 0;
    repeated += !known
                     .insert({at.sun_zenith, at.view_zenith, at.relative_azimuth, sample.channel,
                              sample.value, kind})
                     .second;
  }
  if (repeated == 0) return {};
  return fmt::format(
      "{} of {} samples repeat the direction, wavelength and value of another; each counts as a "
      "sample of its own",
      repeated, data.samples.size());
}

std::optional<std::string> held_aerosol(const FitOptions& options, const SkyModel& model,
                                        const Atmosphere<double>& atmosphere,
                                        const std::vector<FreeParameter>& parameters) {
  const Constituent<double>* const aerosol = main_aerosol(atmosphere);
  if (options.free || aerosol == nullptr) return std::nullopt;
  const auto of_aerosol = [&](const Parameter& id) { return id.constituent() == aerosol->name; };
  if (std::ranges::any_of(parameters, of_aerosol, &FreeParameter::id) ||
      std::ranges::any_of(options.fix | std::views::keys, of_aerosol))
    return std::nullopt;
  for (const Parameter& id : parameters_of(atmosphere)) {
    if (!of_aerosol(id) || !model.can_fit(id)) continue;
    return fmt::format(
        "the aerosol {} stays as the preset has it: by default parameters of an aerosol named "
        "mie are free; --free names others, as {} (skyfit parameters lists them)",
        aerosol->name, parameter_info(id, atmosphere).name);
  }
  return std::nullopt;
}

Atmosphere<double> as_given(Atmosphere<double> atmosphere, const FitOptions& options) {
  for (const auto& [id, value] : options.fix) {
    if (has_parameter(atmosphere, id)) set_parameter(atmosphere, id, value);
  }
  return atmosphere;
}

}  // namespace skyfit::fit
