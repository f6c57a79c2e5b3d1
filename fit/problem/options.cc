// SPDX-License-Identifier: Apache-2.0
#include "fit/problem/options.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "data_refs/units.h"
#include "model/numerics/angles.h"

namespace skyfit::fit {
namespace {

template <class T>
void require(bool holds, std::string_view name, const T& value, std::string_view constraint) {
  if (!holds) {
    throw std::invalid_argument(fmt::format("fit.{} = {}: must be {}", name, value, constraint));
  }
}

void require_prior(std::string_view name, const Prior& prior) {
  if (std::isfinite(prior.mean) && std::isfinite(prior.sigma) && prior.sigma > 0) return;
  throw std::invalid_argument(
      fmt::format("fit.prior: {} = {:.9g}:{:.9g}: must be a finite mean and a sigma > 0", name,
                  prior.mean, prior.sigma));
}

void require_bounds(std::string_view name, const Bounds& bounds) {
  if (std::isfinite(bounds.lower) && std::isfinite(bounds.upper) && bounds.lower < bounds.upper)
    return;
  throw std::invalid_argument(
      fmt::format("fit.bounds: {} = {:.9g}:{:.9g}: must be finite, the lower below the upper one",
                  name, bounds.lower, bounds.upper));
}

void require_noise(const NoiseModel& noise) {
  require(std::isfinite(noise.relative) && noise.relative >= 0, "noise_relative", noise.relative,
          ">= 0");
  require(std::isfinite(noise.floor) && noise.floor >= 0, "noise_floor", noise.floor, ">= 0");
  require(noise.relative > 0 || noise.floor > 0, "noise_relative", noise.relative,
          "> 0 where the floor is 0");
}

// Whether the samples with weight state their sigma, but for irradiances beside a sky.
bool states_sigma(const refs::Reference& reference) {
  int samples = 0, with_sigma = 0;
  for (const refs::Sample& sample : reference.samples) {
    if (sample.weight == 0 || refs::is_beside_sky(reference, sample)) continue;
    ++samples;
    with_sigma += sample.sigma.has_value();
  }
  if (with_sigma != 0 && with_sigma != samples) {
    throw std::invalid_argument(
        fmt::format("{}: {} of {} samples have a sigma: must be all or none", reference.name,
                    with_sigma, samples));
  }
  return with_sigma > 0;
}

}  // namespace

void validate(const FitOptions& options) {
  require(options.lobes == 1 || options.lobes == 2, "lobes", options.lobes, "1 or 2");
  require(options.starts >= 1, "starts", options.starts, ">= 1");
  require(options.starts <= 1000, "starts", options.starts, "<= 1000");
  require(options.max_iterations >= 1, "max_iterations", options.max_iterations, ">= 1");
  require(options.threads >= 1, "threads", options.threads, ">= 1");
  const double exclude_deg = options.exclude_sun * kDegreesPerRadian;
  require(exclude_deg >= 0 && exclude_deg < 180, "exclude_sun_deg", exclude_deg,
          ">= 0 and < 180 degrees");
  for (const auto& [id, prior] : options.priors) require_prior(id.name(), prior);
  for (const auto& [id, prior] : options.instrument_priors)
    require_prior(instrument_info(id).name, prior);
  for (const auto& [id, bounds] : options.bounds) require_bounds(id.name(), bounds);
  for (const auto& [id, value] : options.fix) {
    require(std::isfinite(value), fmt::format("fix.{}", id.name()), value, "finite");
  }
  if (options.site_pressure_hpa) {
    const double pressure = *options.site_pressure_hpa;
    require(std::isfinite(pressure) && pressure > 0, "site_pressure_hpa", pressure, "> 0 hPa");
  }
  if (options.noise) require_noise(*options.noise);
  require(std::isfinite(options.loss_width) && options.loss_width > 0, "loss_width",
          options.loss_width, "> 0 sigmas");
  if (options.start) skyfit::validate(options.start->atmosphere);
}

Likelihood likelihood_of(const FitOptions& options, const refs::Reference& reference) {
  Likelihood likelihood;
  likelihood.link = options.link.value_or(default_link(reference.quantity));
  likelihood.scale = options.scale.value_or(default_scale(reference.quantity));
  if (reference.quantity == refs::Quantity::kRelativeLuminance &&
      likelihood.scale != Scale::kProfiled) {
    throw std::invalid_argument(
        fmt::format("fit.scale = {}: must be profiled for a relative luminance ({}), which has no "
                    "absolute value",
                    scale_name(likelihood.scale), reference.name));
  }
  likelihood.noise = options.noise.value_or(NoiseModel{});
  likelihood.noise_is_known = options.noise || refs::is_irradiance(reference.quantity) ||
                              (likelihood.link == Link::kLog && states_sigma(reference));
  likelihood.loss = options.loss;
  likelihood.loss_width = options.loss_width;
  return likelihood;
}

Pointing pointing_of(const FitOptions& options, const refs::Reference& reference) {
  const bool irradiance = refs::is_irradiance(reference.quantity);
  if (irradiance && options.pointing.value_or(Pointing::kStated) != Pointing::kStated) {
    throw std::invalid_argument(fmt::format(
        "fit.pointing = {}: must be stated for an {} ({}), which has no direction",
        pointing_name(*options.pointing), refs::quantity_name(reference.quantity), reference.name));
  }
  return options.pointing.value_or(
      irradiance || reference.quantity == refs::Quantity::kRelativeLuminance ? Pointing::kStated
                                                                             : Pointing::kAzimuth);
}

}  // namespace skyfit::fit
