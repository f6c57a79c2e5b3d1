// SPDX-License-Identifier: Apache-2.0
// `tables`: the renderer's look-up tables (model/tables/tables.h) as a sky model, at any
// wavelengths, four to a set of tables. What it costs is the tables, a second per four wavelengths;
// what it says differs from `reference`, whose light the tables hold, by the interpolation in them.
#pragma once

#include <memory>
#include <mutex>
#include <vector>

#include "model/sky_model.h"
#include "model/tables/tables.h"

namespace skyfit {

class TableModel final : public SkyModel {
 public:
  // Throws std::invalid_argument.
  explicit TableModel(int threads, Transfer transfer = Transfer::kVector);
  std::string_view name() const override { return "tables"; }
  Transfer transfer() const override { return transfer_; }
  // Has no derivatives: throws std::invalid_argument when asked for any.
  SkyValues radiance(const Atmosphere<double>& atmosphere,
                     std::span<const WavelengthNode> wavelengths, std::span<const SkyPoint> points,
                     std::span<const Parameter> derivatives) const override;
  std::size_t prepare(const Atmosphere<double>& atmosphere,
                      std::span<const WavelengthNode> wavelengths) const override;

 private:
  struct Kept {
    Atmosphere<double> atmosphere;
    std::vector<WavelengthNode> wavelengths;
    std::vector<AtmosphereTables> tables;  // one per four wavelengths
  };
  std::shared_ptr<const Kept> tables_for(const Atmosphere<double>& atmosphere,
                                         std::span<const WavelengthNode> wavelengths) const;
  int threads_;
  Transfer transfer_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const Kept> kept_;
};

}  // namespace skyfit
