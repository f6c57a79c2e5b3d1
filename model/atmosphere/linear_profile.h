// SPDX-License-Identifier: Apache-2.0
// A relative density that is linear between corners and 0 above the last; below the first, at the
// ground, it stays what it is there. Heights in metres.
#pragma once

#include <utility>

#include "model/atmosphere/table_format.h"

namespace skyfit {

// Columns height_m, ascending from 0, and relative_density, >= 0 and not all 0.
extern const TableFormat kProfileFormat;

class LinearProfile {
 public:
  // Throws std::invalid_argument unless the table is as kProfileFormat demands.
  explicit LinearProfile(TwoColumns table);

  // Of any sign, for the derivative of a profile; heights may repeat where it jumps.
  static LinearProfile of_any_sign(TwoColumns table) { return {std::move(table), Unchecked{}}; }

  const TwoColumns& table() const { return table_; }
  const std::vector<double>& heights() const { return table_.x; }
  const std::vector<double>& densities() const { return table_.y; }

  double density(double height) const;
  // On the line through the corners `piece` and `piece` + 1.
  double density_in(std::size_t piece, double height) const {
    const double length = table_.x[piece + 1] - table_.x[piece];
    const double share = (height - table_.x[piece]) / length;
    return (1 - share) * table_.y[piece] + share * table_.y[piece + 1];
  }
  // Mean under the weight that rises linearly from `low` to `height` and falls to `high`; either
  // side may be empty. It misses no layer, however thin.
  double mean_density(double low, double height, double high) const;
  double vertical_column() const { return column_below_.back(); }  // metres of density 1

  // The height above which `share` (0 .. 1) of the vertical column lies.
  double height_below(double share) const;

 private:
  struct Unchecked {};
  LinearProfile(TwoColumns table, Unchecked);

  TwoColumns table_;
  std::vector<double> column_below_;  // from the ground to each height
};

}  // namespace skyfit
