// SPDX-License-Identifier: Apache-2.0
#include "model/literature/evaluate.h"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>

#include "model/numerics/angles.h"

namespace skyfit::literature {

void check_request(std::string_view model, const Atmosphere<double>& atmosphere,
                   std::span<const SkyPoint> points, std::span<const Parameter> derivatives) {
  validate(atmosphere);
  for (const SkyPoint& point : points) check_point(model, point);
  for (const Parameter& parameter : derivatives) check_derivative(model, atmosphere, parameter);
  int molecules = 0, aerosols = 0;
  for (const Constituent<double>& c : atmosphere.constituents) {
    if (!scatters(c)) continue;
    int& count = c.phase.type == PhaseType::kRayleigh ? molecules : aerosols;
    if (++count == 1) continue;
    throw std::invalid_argument(
        fmt::format("{} model: constituent \"{}\": expected at most one with Rayleigh's phase "
                    "function and one other that scatters; the reference model has no such limit",
                    model, c.name));
  }
}

void check_daylight(std::string_view model, std::span<const SkyPoint> points, double highest_m) {
  for (const SkyPoint& point : points) {
    check_model_value(model, point.sun_zenith < 0.5 * std::numbers::pi, "sun zenith (deg)",
                      point.sun_zenith * kDegreesPerRadian, "below 90: the model has no twilight");
    check_model_value(model, point.altitude_m <= highest_m, "altitude_m", point.altitude_m,
                      fmt::format("at most {:.9g}, as high as the model is valid", highest_m));
  }
}

SkyRayTables closed_form(SkyRayMapping mapping, const DaylightLimits& limits,
                         const Atmosphere<double>& atmosphere) {
  const Table none{1, 1, 1, std::vector<float>(4)};
  SkyRayTables rays{mapping, none, none};
  rays.limits = {limits.model,
                 std::min(limits.highest_m, atmosphere.top_radius_m - atmosphere.bottom_radius_m)};
  return rays;
}

AirAtNodes air_at_nodes(const Atmosphere<double>& atmosphere,
                        std::span<const WavelengthNode, 4> nodes) {
  const Shells shells = shells_of(atmosphere, Keep::kScatterers);
  const Atmosphere<Dual<0>> clear = without_absorption(seeded<0>(atmosphere, {}));
  AirAtNodes all;
  const double thickness = atmosphere.top_radius_m - atmosphere.bottom_radius_m;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const ClearAir<0> air = clear_air(shells, clear, nodes[k]);
    all.air[k] = air.air.v;
    all.aerosol[k] = air.aerosol_scattering.v;
    all.air_scale_height_m = air.air_profile < 0 ? thickness : air.air_scale_height.v;
    all.aerosol_scale_height_m = air.aerosol_profile < 0 ? thickness : air.aerosol_scale_height.v;
  }
  return all;
}

void check_exponential(std::string_view model, const Atmosphere<double>& atmosphere) {
  for (const Constituent<double>& c : atmosphere.constituents) {
    if (!scatters(c) || c.profile.type == ProfileType::kExponential) continue;
    throw std::invalid_argument(
        fmt::format("{} model: {}.profile: must be exponential", model, c.name));
  }
}

}  // namespace skyfit::literature
