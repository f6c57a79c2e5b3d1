// SPDX-License-Identifier: Apache-2.0
// What the models share that give CIE X, Y, Z of a sky by a formula over the turbidity: the
// turbidity of an atmosphere, and a spectrum that has such a colour. Everything else of the
// atmosphere is left out, unless the formula asks for it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "model/literature/evaluate.h"

namespace skyfit::literature {

// Vertical optical depth of air and aerosol over that of air, (tau_R + tau_M) / tau_R, of
// extinction at 550 nm. Without air infinite, without both not a number.
double turbidity_of(const Atmosphere<double>& atmosphere);

template <int N>
Dual<N> turbidity_of(const Shells& shells, const Atmosphere<Dual<N>>& atmosphere) {
  const auto air = clear_air(shells, atmosphere, {550, 0});
  const auto column = [&](int profile, const Dual<N>& scale_height) {
    if (profile < 0) return Dual<N>();
    const Column unit = air.profiles[static_cast<std::size_t>(profile)].vertical_column();
    return scale_height.chain(unit.value, unit.by_shape[0]);
  };
  return Dual<N>(1.0) + air.aerosol_extinction *
                            column(air.aerosol_profile, air.aerosol_scale_height) /
                            (air.air * column(air.air_profile, air.air_scale_height));
}

// The skies that a formula is made for.
struct TurbidityDomain {
  std::string_view model;
  double least, most;  // turbidity
  double highest_m;    // of the eye
};

// Whether anything scatters; without, the sky is dark. Throws std::domain_error that names the
// model where the turbidity is not in its domain.
bool is_lit(const TurbidityDomain& domain, double turbidity);

// Whether a fit may vary the parameter: of the turbidity it varies the aerosol's amount alone.
bool is_aerosol_amount(const Parameter& parameter);

// Spectra for colours: the solar irradiance times the polynomial of degree 2 in wavelength that has
// the X, Y, Z, so that a rule of few wavelengths gives them back. At the ends of the spectrum it is
// negative for some reddish skies.
class SpectrumOfXyz {
 public:
  explicit SpectrumOfXyz(const SpectralData& spectra);
  // Radiance per unit solar irradiance, 1/sr, per cd/m^2 of X, Y and Z.
  std::array<double, 3> at(double wavelength_nm) const;

 private:
  // [power][X, Y, Z]: coefficient of the power of the wavelength (550 nm = 1).
  std::array<std::array<double, 3>, 3> power_from_xyz_;
};

// Throws std::invalid_argument for points beneath the horizon, without sun or above the domain's
// height.
void check_formula_points(const TurbidityDomain& domain, std::span<const SkyPoint> points);

// SkyModel::sky_rays() of such a formula, with the numbers that all have. Throws as is_lit() does,
// and std::invalid_argument for profiles of air and aerosol that are not exponential.
SkyRayTables rays_of_formula(const TurbidityDomain& domain, SkyRayMapping mapping,
                             const SpectrumOfXyz& spectrum, const Atmosphere<double>& atmosphere,
                             std::span<const WavelengthNode, 4> nodes);

// SkyModel::radiance() of such a formula. formula(atmosphere, turbidity), with dual numbers,
// returns what gives X, Y, Z, cd/m^2, for a SkyPoint and its angle from the sun, radians. Throws
// as check_formula_points() and is_lit() do.
template <class Formula>
SkyValues radiance_of_formula(const TurbidityDomain& domain, const SpectrumOfXyz& spectrum,
                              const Atmosphere<double>& atmosphere,
                              std::span<const WavelengthNode> wavelengths,
                              std::span<const SkyPoint> points,
                              std::span<const Parameter> derivatives, const Formula& formula) {
  check_request(domain.model, atmosphere, points, derivatives);
  check_formula_points(domain, points);
  const bool lit = is_lit(domain, turbidity_of(atmosphere));
  const Shells shells = shells_of(atmosphere, Keep::kScatterers);
  return evaluate<kAllAtOnce>(
      atmosphere, wavelengths, points.size(), derivatives,
      [&]<int N>(const Atmosphere<Dual<N>>& air, const WavelengthNode& node,
                 std::span<Dual<N>> out) {
        std::ranges::fill(out, Dual<N>(0.0));
        if (!lit) return;
        auto xyz_of = formula(air, turbidity_of(shells, air));
        const std::array<double, 3> from_xyz = spectrum.at(node.wavelength_nm);
        for (std::size_t i = 0; i < points.size(); ++i) {
          const double from_sun = std::acos(view_of(atmosphere, points[i]).nu);
          const std::array<Dual<N>, 3> xyz = xyz_of(points[i], from_sun);
          for (std::size_t c = 0; c < 3; ++c) out[i] += from_xyz[c] * xyz[c];
        }
      });
}

}  // namespace skyfit::literature
