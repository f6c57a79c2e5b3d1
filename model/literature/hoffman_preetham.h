// SPDX-License-Identifier: Apache-2.0
// `hoffman-preetham`: Hoffman & Preetham 2002, "Rendering Outdoor Light Scattering in Real Time":
// air and aerosol of constant density, one scattering in closed form,
//   L = L0 F + (beta_R P_R + beta_M P_M) / (beta_R + beta_M) E (1 - F),
//   F = exp(-(beta_R s_R + beta_M s_M)).
// A ray to the ground crosses its own length of density 1; a ray to the sky the scale heights times
// Kasten's relative air mass (model/shared/closed_forms.glsl), and so does the sun's light E, which
// is that at the eye. The ground reflects the sun alone.
// Left out: absorption and ozone, every further scattering, the change of the sun's light along the
// ray, tabulated profiles. Valid near the ground; by day, up to 10 km, where Nielsen 2003 compares
// it with his (figure 7.11): from there its sky is as thick as from the ground.
#pragma once

#include "model/sky_model.h"

namespace skyfit {

class HoffmanPreethamModel final : public SkyModel {
 public:
  std::string_view name() const override { return "hoffman-preetham"; }
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override;
  std::optional<SkyRayTables> sky_rays(const Atmosphere<double>& atmosphere,
                                       std::span<const WavelengthNode, 4> nodes) const override;
  bool can_fit(const Parameter& parameter) const override;
};

}  // namespace skyfit
