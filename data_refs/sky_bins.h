// SPDX-License-Identifier: Apache-2.0
// Pixels of the sky averaged over bins: rows of cells of about equal angle, or the patches of
// Tregenza. Directions: azimuth (SkyDirection::relative_azimuth) clockwise from north.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "data_refs/sampling.h"

namespace skyfit::refs {

struct SkyBin {
  int number;              // from 1: rows from the horizon up, in a row from north clockwise
  SkyDirection direction;  // the mean of the pixels used; of the bin when there is none
  double luminance;        // their mean by solid angle, 0 when there is none
  std::string flaw;        // why the bin is not to be used; empty otherwise
};

class SkyBins {
 public:
  // 90 / bin_deg rows, rounded, of cells about as wide as high; 12 means Tregenza's patches.
  explicit SkyBins(double bin_deg);

  // A pixel with a flaw is not used but counts as part of its bin.
  void add(const SkyDirection& direction, double solid_angle_sr, double luminance,
           std::string_view flaw);

  std::vector<SkyBin> result() const;
  SkyBin brightest() const;  // of those without a flaw; of all when there is none

  // Solid angle of the pixels of every flaw, as a part of that of all pixels.
  std::map<std::string, double> shares_not_used() const;

 private:
  struct Row {
    double low_zenith, high_zenith;
    int cells;
    std::size_t first;  // index of its first bin
  };
  struct Sum {
    double used_sr = 0, luminance_sr = 0;
    double east_sr = 0, north_sr = 0, up_sr = 0;  // sum of the directions of the pixels used
    std::map<std::string, double, std::less<>> flaw_sr;
  };

  void add_tregenza_rows(double height);
  void add_row(double low_zenith, double high_zenith, int cells);
  std::size_t bin_of(const SkyDirection& direction) const;
  SkyBin bin(const Row& row, int cell) const;

  std::vector<Row> rows_;  // from the horizon up
  std::vector<Sum> sums_;
};

}  // namespace skyfit::refs
