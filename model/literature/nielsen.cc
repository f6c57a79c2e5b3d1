// SPDX-License-Identifier: Apache-2.0
#include "model/literature/nielsen.h"

#include <numbers>

#include "model/atmosphere/phase_moments.h"
#include "model/literature/evaluate.h"
#include "model/shared/shared.h"

namespace skyfit {
namespace {

constexpr std::string_view kName = "nielsen";
constexpr double kHighest = 30e3;                            // m
constexpr double kAirTerrain = 15e3, kAerosolTerrain = 5e3;  // scale heights, m

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
                    const SkyPoint& point, const View& view, NielsenMean mean) {
  Shared<Dual<N>> shared;
  Shared<double> numbers;
  const double height = point.altitude_m, mu_s = std::cos(point.sun_zenith);
  const auto through_sky = [&](double mu) {
    return exp(-(air.air * numbers.nielsen_sky_depth(mu, numbers.nielsen_air_zenith_depth(height)) +
                 air.aerosol_scattering *
                     numbers.nielsen_sky_depth(mu, numbers.nielsen_aerosol_zenith_depth(height))));
  };
  const auto terrain_depth = [&](double length, double scale_height) {
    return mean == NielsenMean::kOfDensities
               ? numbers.nielsen_terrain_depth(height, 0, length, scale_height)
               : numbers.nielsen_mean_height_depth(height, 0, length, scale_height);
  };
  const auto through_terrain = [&](double length) {
    return exp(-(air.air * terrain_depth(length, kAirTerrain) +
                 air.aerosol_scattering * terrain_depth(length, kAerosolTerrain)));
  };
  const Dual<N> g = shared.nielsen_asymmetry(Dual<N>(height), Dual<N>(point.sun_zenith),
                                             aerosol.multiplier, aerosol.hazy_g);
  constexpr double kPi = std::numbers::pi;
  const double air_phase = 3 / (16 * kPi) * (2 + 0.5 * view.nu * view.nu);  // as published
  const bool ground = view.ray.hits_ground;
  const Dual<N> sun = through_sky(mu_s), through = ground
                                                       ? through_terrain(view.ray.length)
                                                       : through_sky(std::cos(point.view_zenith));
  const Dual<N> scattered = shared.mixed_path_inscatter(
      air.air, Dual<N>(air_phase), air.aerosol_scattering,
      shared.lobe_phase(static_cast<int>(aerosol.type), g, Dual<N>(view.nu)), through);
  if (!ground) return sun * scattered;
  return sun * (scattered + air.ground_albedo * (mu_s / kPi) * through);
}

}  // namespace

SkyValues NielsenModel::radiance(const Atmosphere<double>& atmosphere,
                                 std::span<const WavelengthNode> wavelengths,
                                 std::span<const SkyPoint> points,
                                 std::span<const Parameter> derivatives) const {
  literature::check_request(kName, atmosphere, points, derivatives);
  literature::check_daylight(kName, points, kHighest);
  const Shells shells = shells_of(atmosphere, Keep::kScatterers);
  return literature::evaluate<literature::kAllAtOnce>(
      atmosphere, wavelengths, points.size(), derivatives,
      [&]<int N>(const Atmosphere<Dual<N>>& seeded_air, const WavelengthNode& node,
                 std::span<Dual<N>> out) {
        const Atmosphere<Dual<N>> clear = literature::without_absorption(seeded_air);
        const auto air = literature::clear_air(shells, clear, node);
        const Aerosol<N> aerosol = aerosol_of(literature::clear_air(shells, clear, {550, 0}));
        for (std::size_t i = 0; i < points.size(); ++i) {
          out[i] = radiance_of(air, aerosol, points[i], literature::view_of(atmosphere, points[i]),
                               mean_);
        }
      });
}

// Its scale heights are its own.
bool NielsenModel::can_fit(const Parameter& parameter) const {
  return literature::can_fit_without_absorption(parameter) &&
         parameter.quantity() != Quantity::kScaleHeight;
}

}  // namespace skyfit
