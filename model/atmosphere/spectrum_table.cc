// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/spectrum_table.h"

#include <utility>

namespace skyfit {
namespace {

std::optional<TableFault> values_fault(const TwoColumns& table, double highest,
                                       const char* expectation) {
  for (std::size_t i = 0; i < table.y.size(); ++i) {
    if (!(table.y[i] >= 0 && table.y[i] <= highest)) return TableFault{1, i, {}, expectation};
  }
  return {};
}

std::optional<TableFault> shape_fault(const TwoColumns& table) {
  if (auto fault = ascending_fault(kShapeFormat, table, {})) return fault;
  if (!(table.x.front() > 0)) return TableFault{0, 0, {}, "a wavelength > 0 nm"};
  if (auto fault = values_fault(table, 1e300, "a number >= 0")) return fault;
  if (std::ranges::all_of(table.y, [](double y) { return y == 0; }))
    return TableFault{1, {}, "only zeros", "a number > 0 somewhere"};
  return {};
}

std::optional<TableFault> albedo_fault(const TwoColumns& table) {
  if (auto fault = ascending_fault(kAlbedoFormat, table, {})) return fault;
  if (!(table.x.front() > 0)) return TableFault{0, 0, {}, "a wavelength > 0 nm"};
  return values_fault(table, 1, "an albedo from 0 to 1");
}

}  // namespace

const TableFormat kShapeFormat{{"wavelength_nm", "relative_coefficient"}, shape_fault};
const TableFormat kAlbedoFormat{{"wavelength_nm", "single_scattering_albedo"}, albedo_fault};

SpectrumTable::SpectrumTable(TwoColumns table, const TableFormat& format)
    : table_(std::move(table)) {
  expect_no_fault(format, table_);
}

}  // namespace skyfit
