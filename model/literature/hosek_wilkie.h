// SPDX-License-Identifier: Apache-2.0
// `hosek-wilkie`: Hosek & Wilkie 2012, "An Analytic Model for Full Spectral Sky-Dome Radiance", in
// their version for CIE X, Y, Z: for each of them L = L_mean F(theta, gamma), with the view's
// zenith angle theta, its angle gamma from the sun and eq. 8 of the paper,
//   F = (1 + A exp(B / (cos theta + 0.01)))
//       (C + D exp(E gamma) + F cos^2 gamma + G chi(H, gamma) + I cos^(1/2) theta),
//   chi(g, gamma) = (1 + cos^2 gamma) / (1 + g^2 - 2 g cos gamma)^(3/2).
// L_mean and A .. I are linear in the turbidity between whole numbers and in the ground's albedo,
// and Bezier curves of degree 5 in (solar elevation / 90 deg)^(1/3), fitted by the authors to path
// tracing. The turbidity is the preset's, literature::turbidity_of(), the albedo that of the ground
// at 550 nm. The spectrum is not that of the paper: it is the one that literature::SpectrumOfXyz
// has for the model's X, Y, Z. Left out: everything else of the atmosphere. Valid on the ground,
// up to 3 km high, toward the sky, sun above the horizon, turbidity 1 .. 10, albedo 0 .. 1; throws
// std::domain_error for a turbidity outside. Before the ground, frames have the paths of
// model/literature/preetham.h, which the paper leaves open, in the light of this sky.
#pragma once

#include <array>
#include <cmath>

#include "model/literature/turbidity_sky.h"
#include "model/shared/shared.h"

namespace skyfit {

// A, B, C, D, E, F, G, H, I and L_mean, W m^-2 sr^-1 nm^-1 summed with a colour matching function.
template <class T>
using HosekWilkieShape = std::array<T, 10>;

// The shapes of one channel under one sun: [albedo 0, 1][turbidity 1 .. 10].
using HosekWilkieShapes = std::array<std::array<HosekWilkieShape<double>, 10>, 2>;

// Those of X, Y and Z; sun_zenith in radians, 0 to pi / 2.
std::array<HosekWilkieShapes, 3> hosek_wilkie_shapes(double sun_zenith);

// The shape for a turbidity of 1 to 10 and an albedo of 0 to 1. T is double or a dual number; at a
// whole turbidity the derivative is that of the interval above it, at 10 of that below.
template <class T>
HosekWilkieShape<T> hosek_wilkie_shape(const HosekWilkieShapes& shapes, const T& turbidity,
                                       const T& albedo) {
  std::size_t low = 0;  // turbidity - 1
  while (low < 8 && !(turbidity < T(static_cast<double>(low) + 2))) ++low;
  const T share = turbidity - T(static_cast<double>(low) + 1);
  HosekWilkieShape<T> shape;
  for (std::size_t i = 0; i < shape.size(); ++i) {
    const auto at = [&](std::size_t ground) {
      const double a = shapes[ground][low][i], b = shapes[ground][low + 1][i];
      return T(a) + (b - a) * share;
    };
    shape[i] = at(0) + albedo * (at(1) - at(0));
  }
  return shape;
}

// X, Y or Z, cd/m^2, for the cosine of the view's zenith angle, above 0, and the angle from the
// sun, radians.
template <class T>
T hosek_wilkie_light(const HosekWilkieShape<T>& shape, double mu, double gamma) {
  const auto& [a, b, c, d, e, f, g, h, i, mean] = shape;
  return Shared<T>{}.hosek_wilkie_light(T(mu), T(gamma), T(std::cos(gamma)), a, b, c, d, e, f, g, h,
                                        i, mean);
}

class HosekWilkieModel final : public SkyModel {
 public:
  explicit HosekWilkieModel(const SpectralData& spectra) : spectrum_(spectra) {}
  std::string_view name() const override { return "hosek-wilkie"; }
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override;
  std::optional<SkyRayTables> sky_rays(const Atmosphere<double>& atmosphere,
                                       std::span<const WavelengthNode, 4> nodes) const override;
  // The aerosol's amount and the ground's albedo.
  bool can_fit(const Parameter& parameter) const override;

 private:
  literature::SpectrumOfXyz spectrum_;
};

}  // namespace skyfit
