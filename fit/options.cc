// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fit/fit.h"

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

}  // namespace

void validate(const FitOptions& options) {
  require(options.lobes == 1 || options.lobes == 2, "lobes", options.lobes, "1 or 2");
  require(options.starts >= 1, "starts", options.starts, ">= 1");
  require(options.starts <= 1000, "starts", options.starts, "<= 1000");
  require(options.max_iterations >= 1, "max_iterations", options.max_iterations, ">= 1");
  require(options.threads >= 1, "threads", options.threads, ">= 1");
  const double exclude_deg = options.exclude_sun * 180 / std::numbers::pi;
  require(exclude_deg >= 0 && exclude_deg < 180, "exclude_sun_deg", exclude_deg,
          ">= 0 and < 180 degrees");
  for (const auto& [id, prior] : options.priors) require_prior(id.name(), prior);
  for (const auto& [id, value] : options.fix) {
    require(std::isfinite(value), fmt::format("fix.{}", id.name()), value, "finite");
  }
  if (options.site_pressure_hpa) {
    const double pressure = *options.site_pressure_hpa;
    require(std::isfinite(pressure) && pressure > 0, "site_pressure_hpa", pressure, "> 0 hPa");
  }
  if (options.start) skyfit::validate(options.start->atmosphere);
}

}  // namespace skyfit::fit
