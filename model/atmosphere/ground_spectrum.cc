// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/ground_spectrum.h"

#include <cmath>
#include <utility>

namespace skyfit {
namespace {

std::optional<TableFault> ground_fault(const TwoColumns& table) {
  if (auto fault = ascending_fault(kGroundFormat, table, {})) return fault;
  if (!(table.x.front() > 0)) return TableFault{0, 0, {}, "a wavelength > 0"};
  for (std::size_t i = 0; i < table.y.size(); ++i) {
    if (!(table.y[i] >= 0) || !std::isfinite(table.y[i])) {
      return TableFault{1, i, {}, "an albedo >= 0"};
    }
  }
  if (!(clamped_interpolation(table, GroundSpectrum::kWavelengthNm) > 0)) {
    return TableFault{1, {}, "0 at 550 nm", "an albedo > 0 there"};
  }
  return {};
}

}  // namespace

const TableFormat kGroundFormat{{"wavelength_nm", "relative_albedo"}, ground_fault};

GroundSpectrum::GroundSpectrum(TwoColumns table) : table_(std::move(table)) {
  expect_no_fault(kGroundFormat, table_);
  const double at_550 = clamped_interpolation(table_, kWavelengthNm);
  for (double& value : table_.y) value /= at_550;
}
}  // namespace skyfit
