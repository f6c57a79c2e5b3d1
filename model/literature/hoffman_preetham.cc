// SPDX-License-Identifier: Apache-2.0
#include "model/literature/hoffman_preetham.h"

#include <numbers>

#include "model/atmosphere/phase_moments.h"
#include "model/literature/evaluate.h"
#include "model/shared/shared.h"

namespace skyfit {
namespace {

constexpr std::string_view kName = "hoffman-preetham";
constexpr double kHighest = 10e3;  // m

// Of a ray to the sky, metres of density 1.
template <int N>
struct Depths {
  Dual<N> air, aerosol;
};
template <int N>
Depths<N> to_sky(const literature::ClearAir<N>& air, double mu) {
  const double mass = Shared<double>{}.relative_air_mass(mu);
  return {mass * air.air_scale_height, mass * air.aerosol_scale_height};
}

template <int N>
Dual<N> transmittance(const literature::ClearAir<N>& air, const Depths<N>& depths) {
  return exp(-(air.air * depths.air + air.aerosol_scattering * depths.aerosol));
}

template <int N>
Dual<N> radiance_of(const literature::ClearAir<N>& air, const SkyPoint& point, const View& view) {
  Shared<Dual<N>> shared;
  const double mu_s = std::cos(point.sun_zenith);
  const Dual<N> sun = transmittance(air, to_sky(air, mu_s));
  const bool ground = view.ray.hits_ground;
  const Dual<N> through = transmittance(air, ground ? Depths<N>{view.ray.length, view.ray.length}
                                                    : to_sky(air, std::cos(point.view_zenith)));
  const Dual<N> scattered =
      shared.mixed_path_inscatter(air.air, shared.rayleigh_phase(air.depolarisation, view.nu),
                                  air.aerosol_scattering, phase_value(air.phase, view.nu), through);
  if (!ground) return sun * scattered;
  const Dual<N> reflected = air.ground_albedo * (mu_s / std::numbers::pi);
  return sun * (scattered + reflected * through);
}

}  // namespace

SkyValues HoffmanPreethamModel::radiance(const Atmosphere<double>& atmosphere,
                                         std::span<const WavelengthNode> wavelengths,
                                         std::span<const SkyPoint> points,
                                         std::span<const Parameter> derivatives) const {
  literature::check_request(kName, atmosphere, points, derivatives);
  literature::check_daylight(kName, points, kHighest);
  literature::check_exponential(kName, atmosphere);
  const Shells shells = shells_of(atmosphere, Keep::kScatterers);
  return literature::evaluate<literature::kAllAtOnce>(
      atmosphere, wavelengths, points.size(), derivatives,
      [&]<int N>(const Atmosphere<Dual<N>>& air, const WavelengthNode& node,
                 std::span<Dual<N>> out) {
        const auto optics =
            literature::clear_air(shells, literature::without_absorption(air), node);
        for (std::size_t i = 0; i < points.size(); ++i)
          out[i] = radiance_of(optics, points[i], literature::view_of(atmosphere, points[i]));
      });
}

std::optional<SkyRayTables> HoffmanPreethamModel::sky_rays(
    const Atmosphere<double>& atmosphere, std::span<const WavelengthNode, 4>) const {
  literature::check_request(kName, atmosphere, {}, {});
  literature::check_exponential(kName, atmosphere);
  return literature::closed_form(SkyRayMapping::kHoffmanPreetham, {std::string(kName), kHighest},
                                 atmosphere);
}

bool HoffmanPreethamModel::can_fit(const Parameter& parameter) const {
  return literature::can_fit_without_absorption(parameter);
}

}  // namespace skyfit
