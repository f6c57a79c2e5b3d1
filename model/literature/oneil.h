// SPDX-License-Identifier: Apache-2.0
// `oneil`: O'Neil 2005, "Accurate Atmospheric Scattering", GPU Gems 2, chapter 16: single
// scattering summed over five samples in the middle of equal steps along the view ray, from space
// and from inside, to the sky and to the ground, without tables. Optical depths are his polynomial
// (oneil_slant in model/shared/closed_forms.glsl) where planet and air have the one geometry that
// it was fitted to: an atmosphere of 0.025 planet radii, both scale heights a quarter of it. In
// every other geometry they are evaluated in closed form. The source has one scale height; the
// preset's two are used. Five samples are those of its prose; its shader takes a number that it
// does not state, ports of its demo take three.
// Choices (ONeilChoices): the source leaves the Rayleigh phase function out for its demo's sky to
// be bright enough at 90 deg, and has no test of the planet's shadow, in which its polynomial lets
// next to no light through. Here air scatters by its phase function and samples in shadow give no
// light, unless the model is named with ":isotropic-air" and ":no-shadow". The latter needs the
// polynomial: the closed form knows no ray through the planet. Left out: absorption and ozone,
// every further scattering; the ground reflects the sun alone. Few samples do not resolve an
// aerosol that is thin against the ray's length: that error is the method's.
// In frames the shader sums the same samples along every ray, to the sky and to what is seen in
// the air; the sun's light on the ground, and what a path to the ground lets through, have exact
// optical depths there.
#pragma once

#include <string>

#include "model/sky_model.h"

namespace skyfit {

class ONeilModel final : public SkyModel {
 public:
  // What stands behind "oneil:".
  static constexpr std::string_view kSamplesN = "samples=N", kIsotropicAir = "isotropic-air",
                                    kNoShadow = "no-shadow";
  static constexpr int kMostSamples = 1000;

  // Throws std::invalid_argument.
  explicit ONeilModel(int threads, const ONeilChoices& choices = {});
  std::string_view name() const override { return name_; }
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override;
  ScatteredLight scattered_light(const Atmosphere<double>& atmosphere,
                                 std::span<const WavelengthNode> wavelengths,
                                 std::span<const SkyPoint> points) const override;
  std::optional<SkyRayTables> sky_rays(const Atmosphere<double>& atmosphere,
                                       std::span<const WavelengthNode, 4> nodes) const override;
  Atmosphere<double> effective_atmosphere(const Atmosphere<double>& atmosphere) const override;
  bool can_fit(const Parameter& parameter) const override;

 private:
  ONeilChoices choices_for(const Atmosphere<double>& atmosphere) const;
  int threads_;
  ONeilChoices choices_;  // but the depths, which follow from the atmosphere
  std::string name_;
};

// Of names of variants, "samples=3" and so on; others are not looked for.
ONeilChoices oneil_choices(std::span<const std::string_view> names);

}  // namespace skyfit
