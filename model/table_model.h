// SPDX-License-Identifier: Apache-2.0
// `tables`: the renderer's look-up tables (model/tables.h) as a sky model, at any wavelengths, four
// to a set of tables. What it costs is the tables, a second per four wavelengths; what it says
// differs from `reference`, whose light the tables hold, by the interpolation in them.
#pragma once

#include "model/sky_model.h"

namespace skyfit {

class TableModel final : public SkyModel {
 public:
  explicit TableModel(int threads);  // throws std::invalid_argument
  std::string_view name() const override { return "tables"; }
  // Has no derivatives: throws std::invalid_argument when asked for any.
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override;

 private:
  int threads_;
};

}  // namespace skyfit
