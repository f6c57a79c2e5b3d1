// SPDX-License-Identifier: Apache-2.0
// A relative density that is linear between corners and 0 above the last; below the first, at the
// ground, it stays what it is there. Heights in metres.
#pragma once

#include <cstddef>
#include <vector>

namespace skyfit {

class LinearProfile {
 public:
  // Heights ascend from 0, at least two; densities are >= 0 and not all 0, one per height.
  LinearProfile(std::vector<double> heights, std::vector<double> densities);

  const std::vector<double>& heights() const { return heights_; }
  const std::vector<double>& densities() const { return densities_; }

  double density(double height) const;
  // On the line through the corners `piece` and `piece` + 1.
  double density_in(std::size_t piece, double height) const {
    const double length = heights_[piece + 1] - heights_[piece];
    const double share = (height - heights_[piece]) / length;
    return (1 - share) * densities_[piece] + share * densities_[piece + 1];
  }
  double vertical_column() const { return column_below_.back(); }  // metres of density 1

  // The height above which `share` (0 .. 1) of the vertical column lies.
  double height_below(double share) const;

 private:
  std::vector<double> heights_, densities_;
  std::vector<double> column_below_;  // from the ground to each height
};

}  // namespace skyfit
