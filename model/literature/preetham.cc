// SPDX-License-Identifier: Apache-2.0
#include "model/literature/preetham.h"

#include <cmath>

#include "model/shared/preetham.h"

namespace skyfit {

// Found by the formulas of model/shared/preetham.glsl.
template <int N>
Dual<N> cos(const Dual<N>& x) {
  return x.chain(std::cos(x.v), -std::sin(x.v));
}
template <int N>
Dual<N> tan(const Dual<N>& x) {
  const double tangent = std::tan(x.v);
  return x.chain(tangent, 1 + tangent * tangent);
}

namespace {

constexpr literature::TurbidityDomain kDomain = {"preetham", 1.7, 10, 3e3};

template <int N>
std::array<Dual<N>, 3> xyz_of(const Dual<N>& t, double mu, double gamma, double sun_zenith) {
  SharedPreetham<Dual<N>> shared;
  const Dual<N> luminance = shared.preetham_luminance(t, mu, gamma, sun_zenith),
                x = shared.preetham_x(t, mu, gamma, sun_zenith),
                y = shared.preetham_y(t, mu, gamma, sun_zenith);
  return {luminance * x / y, luminance, luminance * (Dual<N>(1.0) - x - y) / y};
}

}  // namespace

PreethamModel::PreethamModel(const SpectralData& spectra) : spectrum_(spectra) {}

SkyValues PreethamModel::radiance(const Atmosphere<double>& atmosphere,
                                  std::span<const WavelengthNode> wavelengths,
                                  std::span<const SkyPoint> points,
                                  std::span<const Parameter> derivatives) const {
  return literature::radiance_of_formula(
      kDomain, spectrum_, atmosphere, wavelengths, points, derivatives,
      []<int N>(const Atmosphere<Dual<N>>&, const Dual<N>& turbidity) {
        return [=](const SkyPoint& point, double from_sun) {
          return xyz_of(turbidity, std::cos(point.view_zenith), from_sun, point.sun_zenith);
        };
      });
}

std::optional<SkyRayTables> PreethamModel::sky_rays(
    const Atmosphere<double>& atmosphere, std::span<const WavelengthNode, 4> nodes) const {
  return literature::rays_of_formula(kDomain, SkyRayMapping::kPreetham, spectrum_, atmosphere,
                                     nodes);
}

bool PreethamModel::can_fit(const Parameter& parameter) const {
  return literature::is_aerosol_amount(parameter);
}

}  // namespace skyfit
