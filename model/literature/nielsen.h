// SPDX-License-Identifier: Apache-2.0
// `nielsen`: Nielsen 2003, "Real Time Rendering of Atmospheric Scattering Effects for Flight
// Simulators": the closed form of Hoffman & Preetham 2002 with the mean of the densities at the two
// ends of a path to the ground, an interpolated depth of the sky, and an asymmetry that follows the
// eye's height, the sun and the haze (model/shared/closed_forms.glsl has all of them).
// The two densities of the published shader, which it swaps in the extinction, are each used with
// their own coefficient, and both ends are halved. Choices where the source is not legible: the
// asymmetry of thick haze is the preset's g (the mean of its lobes), so that a fit has it; the
// factor m on the Mie coefficient is over Hoffman & Preetham's of turbidity 2; the sun's light,
// 9.2 - 550 m, is over 9.2 of that in space, of the star's colour, and constant beyond his thickest
// haze, m = 7e-3. He says that it falls as the sun sinks, but not how: here it does not. His sky
// ends at a level horizon; of an eye above the ground it ends at the horizon that is seen. Left
// out: absorption and ozone, every further scattering, the preset's scale heights (the model has
// its own). Valid by day, the sun above the horizon, up to 30 km, the highest eye of the source.
#pragma once

#include "model/sky_model.h"

namespace skyfit {

// What the source leaves open, or a user may want otherwise (NielsenChoices):
// - of a path to the ground the mean of the densities at its ends, which the source chooses, or the
//   density at the mean of their heights;
// - the air's phase function as published or Rayleigh's;
// - the sun's light as published, or what the model's own sky lets through to the eye (on the
//   ground: to there): that reddens a low sun, and it browns a hazy sky.

// The aerosol of an atmosphere as the model sees it: the lobe's kind, the asymmetry of thick haze,
// the factor on Hoffman & Preetham's Mie coefficient.
struct NielsenAerosol {
  PhaseType lobe = PhaseType::kHenyeyGreenstein;
  double hazy_g = 0, mie_multiplier = 0;
};
NielsenAerosol nielsen_aerosol(const Atmosphere<double>& atmosphere);

class NielsenModel final : public SkyModel {
 public:
  // The names of the choices that are not its own: what stands behind "nielsen:".
  static constexpr std::string_view kMeanHeight = "mean-height", kRayleighPhase = "rayleigh-phase",
                                    kSunThroughSky = "sun-through-sky";

  explicit NielsenModel(const NielsenChoices& choices = {});
  std::string_view name() const override { return name_; }
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override;
  std::optional<SkyRayTables> sky_rays(const Atmosphere<double>& atmosphere,
                                       std::span<const WavelengthNode, 4> nodes) const override;
  bool can_fit(const Parameter& parameter) const override;
  int lobes() const override { return 1; }

 private:
  NielsenChoices choices_;
  std::string name_;
};

// Of such names; others are not looked for.
NielsenChoices nielsen_choices(std::span<const std::string_view> names);

}  // namespace skyfit
