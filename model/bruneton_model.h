// SPDX-License-Identifier: Apache-2.0
// `bruneton`: the renderer's look-up tables (model/tables.h) as a sky model, after Bruneton &
// Neyret 2008, at any wavelengths, four to a set of tables. What it costs is the tables, a second
// per four wavelengths; what it says differs from `reference` by the interpolation in the tables.
#pragma once

#include "model/sky_model.h"

namespace skyfit {

class BrunetonModel final : public SkyModel {
 public:
  explicit BrunetonModel(int threads);  // throws std::invalid_argument
  std::string_view name() const override { return "bruneton"; }
  // Has no derivatives: throws std::invalid_argument when asked for any.
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override;
  SkyValues irradiance(const Atmosphere<double>& atmosphere,
                       std::span<const WavelengthNode> wavelengths, double altitude_m,
                       double sun_zenith, std::span<const Parameter> derivatives) const override;

 private:
  int threads_;
};

}  // namespace skyfit
