// SPDX-License-Identifier: Apache-2.0
// `oneil`: O'Neil 2005, "Accurate Atmospheric Scattering", GPU Gems 2, chapter 16: single
// scattering summed over five samples in the middle of equal steps along the view ray, from space
// and from inside, to the sky and to the ground, without tables. Optical depths are his polynomial
// (oneil_slant in model/shared/closed_forms.glsl) where planet and air have the one geometry that
// it was fitted to: an atmosphere of 0.025 planet radii, both scale heights a quarter of it. In
// every other geometry they are evaluated in closed form. The source has one scale height; the
// preset's two are used. It leaves the Rayleigh phase function out for its demo's sky to be bright
// enough at 90 deg, and has no test of the planet's shadow; here air scatters by its phase
// function, and samples in shadow give no light. Five samples are those of its prose; its shader
// takes a number that it does not state. Left out: absorption and ozone, every further scattering;
// the ground reflects the sun alone. Five samples do not resolve an aerosol that is thin against
// the ray's length: that error is the method's.
#pragma once

#include "model/sky_model.h"

namespace skyfit {

class ONeilModel final : public SkyModel {
 public:
  static constexpr int kSamples = 5;  // of a ray
  explicit ONeilModel(int threads);   // throws std::invalid_argument
  std::string_view name() const override { return "oneil"; }
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override;
  ScatteredLight scattered_light(const Atmosphere<double>& atmosphere,
                                 std::span<const WavelengthNode> wavelengths,
                                 std::span<const SkyPoint> points) const override;
  // None where O'Neil's polynomial is used.
  std::optional<SkyRayTables> sky_rays(const Atmosphere<double>& atmosphere,
                                       std::span<const WavelengthNode, 4> nodes) const override;
  Atmosphere<double> effective_atmosphere(const Atmosphere<double>& atmosphere) const override;
  bool can_fit(const Parameter& parameter) const override;

 private:
  int threads_;
};

}  // namespace skyfit
