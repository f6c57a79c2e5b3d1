// SPDX-License-Identifier: Apache-2.0
#include "model/literature/nielsen.h"

#include <algorithm>
#include <numbers>

#include "model/atmosphere/phase_moments.h"
#include "model/literature/evaluate.h"
#include "model/shared/nielsen_horizon.h"
#include "model/shared/shared.h"

namespace skyfit {
namespace {

constexpr double kHighest = 30e3;  // m

// Hoffman & Preetham's Mie coefficient of turbidity 2 at 550 nm, 1/m:
// 0.434 c pi (2 pi / lambda)^2 K with c = (0.6544 T - 0.6510) 1e-16 and K = 0.678.
double unit_mie_coefficient() {
  constexpr double kPi = std::numbers::pi, kC = (0.6544 * 2 - 0.6510) * 1e-16;
  return 0.434 * kC * kPi * (2 * kPi / 550e-9) * (2 * kPi / 550e-9) * 0.678;
}

// One lobe of the preset's kind whose g is the model's.
template <int N>
struct Aerosol {
  PhaseType type;
  Dual<N> hazy_g;
  Dual<N> multiplier;
};
// `green`: the air at 550 nm.
template <int N>
Aerosol<N> aerosol_of(const literature::ClearAir<N>& green) {
  const PhaseFunction<Dual<N>>& phase = green.phase;
  Aerosol<N> aerosol;
  aerosol.multiplier = green.aerosol_scattering * (1 / unit_mie_coefficient());
  switch (phase.type) {
    case PhaseType::kTwoLobe:
      aerosol.type = phase.lobe;
      aerosol.hazy_g = phase.weight * phase.g1 + (Dual<N>(1.0) - phase.weight) * phase.g2;
      break;
    case PhaseType::kTabulated:
    case PhaseType::kSizeDistribution:
      aerosol.type = PhaseType::kHenyeyGreenstein;
      aerosol.hazy_g = phase_moments(phase, 2)[1];
      break;
    default:
      aerosol.type = phase.type;
      aerosol.hazy_g = phase.g;
  }
  return aerosol;
}

template <int N>
Dual<N> radiance_of(const literature::ClearAir<N>& air, const Aerosol<N>& aerosol,
                    const Atmosphere<double>& planet, const SkyPoint& point,
                    const NielsenChoices& choices) {
  Shared<Dual<N>> shared;
  Shared<double> numbers;
  const double height = point.altitude_m, mu_s = std::cos(point.sun_zenith);
  const View view = literature::view_of(planet, point);
  const auto through_sky = [&](double from_height, double mu) {
    const double level_mu =
        SharedNielsenHorizon<double>{}.nielsen_level_mu(mu, from_height, planet.bottom_radius_m);
    return exp(
        -(air.air * numbers.nielsen_air_sky_depth(level_mu, from_height) +
          air.aerosol_scattering * numbers.nielsen_aerosol_sky_depth(level_mu, from_height)));
  };
  const auto sun_at = [&](double at_height) {
    return choices.sun == NielsenSun::kPublished ? shared.nielsen_sunlight(aerosol.multiplier)
                                                 : through_sky(at_height, mu_s);
  };
  const auto terrain_depth = [&](double length, double scale_height) {
    return choices.mean == NielsenMean::kOfDensities
               ? numbers.nielsen_terrain_depth(height, 0, length, scale_height)
               : numbers.nielsen_mean_height_depth(height, 0, length, scale_height);
  };
  const auto through_terrain = [&](double length) {
    return exp(
        -(air.air * terrain_depth(length, numbers.nielsen_air_scale_height()) +
          air.aerosol_scattering * terrain_depth(length, numbers.nielsen_aerosol_scale_height())));
  };
  const Dual<N> g = shared.nielsen_asymmetry(Dual<N>(height), Dual<N>(point.sun_zenith),
                                             aerosol.multiplier, aerosol.hazy_g);
  const double air_phase = choices.phase == NielsenAirPhase::kPublished
                               ? numbers.nielsen_air_phase(view.nu)
                               : numbers.rayleigh_phase(air.depolarisation, view.nu);
  const bool ground = view.ray.hits_ground;
  const Dual<N> through =
      ground ? through_terrain(view.ray.length) : through_sky(height, std::cos(point.view_zenith));
  const Dual<N> scattered = shared.mixed_path_inscatter(
      air.air, Dual<N>(air_phase), air.aerosol_scattering,
      shared.lobe_phase(static_cast<int>(aerosol.type), g, Dual<N>(view.nu)), through);
  const Dual<N> light = sun_at(height) * scattered;
  if (!ground) return light;
  return light + sun_at(0) * air.ground_albedo * (mu_s / std::numbers::pi) * through;
}

}  // namespace

NielsenModel::NielsenModel(const NielsenChoices& choices) : choices_(choices), name_("nielsen") {
  const auto add = [&](bool chosen, std::string_view name) {
    if (chosen) name_.append(":").append(name);
  };
  add(choices.mean == NielsenMean::kOfHeights, kMeanHeight);
  add(choices.phase == NielsenAirPhase::kRayleigh, kRayleighPhase);
  add(choices.sun == NielsenSun::kThroughTheSky, kSunThroughSky);
}

NielsenChoices nielsen_choices(std::span<const std::string_view> names) {
  const auto chosen = [&](std::string_view name) { return std::ranges::count(names, name) > 0; };
  NielsenChoices choices;
  if (chosen(NielsenModel::kMeanHeight)) choices.mean = NielsenMean::kOfHeights;
  if (chosen(NielsenModel::kRayleighPhase)) choices.phase = NielsenAirPhase::kRayleigh;
  if (chosen(NielsenModel::kSunThroughSky)) choices.sun = NielsenSun::kThroughTheSky;
  return choices;
}

SkyValues NielsenModel::radiance(const Atmosphere<double>& atmosphere,
                                 std::span<const WavelengthNode> wavelengths,
                                 std::span<const SkyPoint> points,
                                 std::span<const Parameter> derivatives) const {
  literature::check_request(name_, atmosphere, points, derivatives);
  literature::check_daylight(name_, points, kHighest);
  const Shells shells = shells_of(atmosphere, Keep::kScatterers);
  return literature::evaluate<literature::kAllAtOnce>(
      atmosphere, wavelengths, points.size(), derivatives,
      [&]<int N>(const Atmosphere<Dual<N>>& seeded_air, const WavelengthNode& node,
                 std::span<Dual<N>> out) {
        const Atmosphere<Dual<N>> clear = literature::without_absorption(seeded_air);
        const auto air = literature::clear_air(shells, clear, node);
        const Aerosol<N> aerosol = aerosol_of(literature::clear_air(shells, clear, {550, 0}));
        for (std::size_t i = 0; i < points.size(); ++i) {
          out[i] = radiance_of(air, aerosol, atmosphere, points[i], choices_);
        }
      });
}

std::optional<SkyRayTables> NielsenModel::sky_rays(const Atmosphere<double>& atmosphere,
                                                   std::span<const WavelengthNode, 4>) const {
  literature::check_request(name_, atmosphere, {}, {});
  SkyRayTables rays =
      literature::closed_form(SkyRayMapping::kNielsen, {name_, kHighest}, atmosphere);
  rays.nielsen = choices_;
  return rays;
}

NielsenAerosol nielsen_aerosol(const Atmosphere<double>& atmosphere) {
  const Aerosol<0> aerosol = aerosol_of(
      literature::clear_air(shells_of(atmosphere, Keep::kScatterers),
                            literature::without_absorption(seeded<0>(atmosphere, {})), {550, 0}));
  return {aerosol.type, aerosol.hazy_g.v, aerosol.multiplier.v};
}

// Its scale heights are its own.
bool NielsenModel::can_fit(const Parameter& parameter) const {
  return literature::can_fit_without_absorption(parameter) &&
         parameter.quantity() != Quantity::kScaleHeight;
}

}  // namespace skyfit
