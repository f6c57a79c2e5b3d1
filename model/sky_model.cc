// SPDX-License-Identifier: Apache-2.0
#include "model/sky_model.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace skyfit {

void check_model_value(std::string_view model, bool good, std::string_view name, double value,
                       std::string_view expected) {
  if (!good)
    throw std::invalid_argument(
        fmt::format("{} model: {} = {:.9g}: must be {}", model, name, value, expected));
}

void check_point(std::string_view model, const SkyPoint& p) {
  const auto check = [&](bool good, std::string_view name, double value,
                         std::string_view expected) {
    check_model_value(model, good, name, value, expected);
  };
  const auto is_zenith = [](double angle) { return angle >= 0 && angle <= std::numbers::pi; };
  check(std::isfinite(p.altitude_m) && p.altitude_m >= 0, "altitude_m", p.altitude_m, ">= 0");
  check(is_zenith(p.sun_zenith), "sun zenith (rad)", p.sun_zenith, "in 0 .. pi");
  check(is_zenith(p.view_zenith), "view zenith (rad)", p.view_zenith, "in 0 .. pi");
  check(std::isfinite(p.relative_azimuth), "relative azimuth (rad)", p.relative_azimuth, "finite");
}

StokesValues SkyModel::stokes(const Atmosphere<double>&, std::span<const WavelengthNode>,
                              std::span<const SkyPoint>, std::span<const Parameter>) const {
  throw std::invalid_argument(
      fmt::format("{} model: gives no Stokes parameters: it is a model of {}", name(),
                  transfer() == Transfer::kScalar ? "scalar transfer" : "radiance alone"));
}

ScatteredLight SkyModel::scattered_light(const Atmosphere<double>&, std::span<const WavelengthNode>,
                                         std::span<const SkyPoint>) const {
  throw std::invalid_argument(
      fmt::format("{} model: cannot be tabulated for rendering: it does not hold for every height, "
                  "direction and sun, or does not part air and aerosol",
                  name()));
}

std::size_t SkyModel::prepare(const Atmosphere<double>& atmosphere,
                              std::span<const WavelengthNode>) const {
  validate(atmosphere);
  return 0;
}

void check_derivative(std::string_view model, const Atmosphere<double>& atmosphere,
                      const Parameter& parameter) {
  if (has_parameter(atmosphere, parameter)) return;
  throw std::invalid_argument(fmt::format("{} model: the atmosphere has no {} to differentiate by",
                                          model, parameter.name()));
}

}  // namespace skyfit
