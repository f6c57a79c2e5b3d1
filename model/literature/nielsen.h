// SPDX-License-Identifier: Apache-2.0
// `nielsen`: Nielsen 2003, "Real Time Rendering of Atmospheric Scattering Effects for Flight
// Simulators": the closed form of Hoffman & Preetham 2002 with the mean of the densities at the two
// ends of a path to the ground, an interpolated depth of the sky, and an asymmetry that follows the
// eye's height, the sun and the haze (model/shared/closed_forms.glsl has all of them).
// The two densities of the published shader, which it swaps in the extinction, are each used with
// their own coefficient, and both ends are halved. Choices where the source is not legible: the
// asymmetry of thick haze is the preset's g (the mean of its lobes), so that a fit has it; the
// factor on the Mie coefficient is over Hoffman & Preetham's of turbidity 2; the sun's light is
// that at the eye, behind the model's own depth of the sky. Left out: absorption and ozone, every
// further scattering, the preset's scale heights (the model has its own). Valid by day, the sun
// above the horizon, up to 30 km, the highest eye of the source. Its light of the sun is another
// one: 9.2 - 550 m for the haze m, times a colour that it does not state.
#pragma once

#include "model/sky_model.h"

namespace skyfit {

// Of a path to the ground: the mean of the densities at its ends, which the source chooses, or the
// density at the mean of their heights.
enum class NielsenMean { kOfDensities, kOfHeights };

class NielsenModel final : public SkyModel {
 public:
  explicit NielsenModel(NielsenMean mean = NielsenMean::kOfDensities) : mean_(mean) {}
  std::string_view name() const override { return "nielsen"; }
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override;
  bool can_fit(const Parameter& parameter) const override;
  int lobes() const override { return 1; }

 private:
  NielsenMean mean_;
};

}  // namespace skyfit
