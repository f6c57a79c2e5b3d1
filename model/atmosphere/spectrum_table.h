// SPDX-License-Identifier: Apache-2.0
// Functions of wavelength that a preset gives as a table: linear between the rows, constant beyond
// them.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>

#include "model/atmosphere/table_format.h"

namespace skyfit {

// Columns wavelength_nm, ascending and > 0, and
extern const TableFormat kShapeFormat;   // relative_coefficient, >= 0 and not all 0; any factor
extern const TableFormat kAlbedoFormat;  // single_scattering_albedo, 0 .. 1

// Linear between the arguments, constant beyond the ends.
inline double clamped_interpolation(const TwoColumns& table, double x) {
  if (x <= table.x.front()) return table.y.front();
  if (x >= table.x.back()) return table.y.back();
  const auto above = std::upper_bound(table.x.begin(), table.x.end(), x);
  const auto i = static_cast<std::size_t>(above - table.x.begin());
  return std::lerp(table.y[i - 1], table.y[i],
                   (x - table.x[i - 1]) / (table.x[i] - table.x[i - 1]));
}

class SpectrumTable {
 public:
  // Throws std::invalid_argument unless the table is as the format demands.
  SpectrumTable(TwoColumns table, const TableFormat& format);

  const TwoColumns& table() const { return table_; }
  double at(double wavelength_nm) const { return clamped_interpolation(table_, wavelength_nm); }

 private:
  TwoColumns table_;
};

}  // namespace skyfit
