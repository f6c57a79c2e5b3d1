// SPDX-License-Identifier: Apache-2.0
// `preetham`: Preetham, Shirley & Smits 1999, "A Practical Analytic Model for Daylight": luminance
// and chromaticity of a clear sky in closed form over the turbidity T, for each of Y, x, y
//   L = L_zenith F(Z, gamma) / F(0, Z_sun),
//   F(Z, gamma) = (1 + A exp(B / cos Z)) (1 + C exp(D gamma) + E cos^2 gamma).
// T is the preset's, literature::turbidity_of(). The spectrum is not that of the paper: it is the
// one that literature::SpectrumOfXyz has for the model's X, Y, Z. Known: far too bright against
// measurements, by a factor of about 2.4. Left out: everything of the atmosphere but T. Valid on
// the ground, up to 3 km high, toward the sky, sun above the horizon, T 1.7 .. 10 (below, F is
// negative at the zenith); throws std::domain_error for a turbidity outside.
//
// Frames, also those of `hosek-wilkie`, have his paths before the ground, section 4: air and
// aerosol with the exponential densities of the preset, lit by the sun as from the ground and by
// the sky. Deviations: he fills a table of the scattered light over all directions and fits
// polynomials to the integrals along a path, here the sky's light comes evenly from its half of all
// directions, and a path is summed in 8 steps; the sun's beam is that of these constituents through
// Kasten's air mass, without his ozone and gases.
#pragma once

#include "model/literature/turbidity_sky.h"

namespace skyfit {

class PreethamModel final : public SkyModel {
 public:
  explicit PreethamModel(const SpectralData& spectra);
  std::string_view name() const override { return "preetham"; }
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override;
  std::optional<SkyRayTables> sky_rays(const Atmosphere<double>& atmosphere,
                                       std::span<const WavelengthNode, 4> nodes) const override;
  // The aerosol's amount alone: the sky fixes one number.
  bool can_fit(const Parameter& parameter) const override;

 private:
  literature::SpectrumOfXyz spectrum_;
};

}  // namespace skyfit
