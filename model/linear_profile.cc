// SPDX-License-Identifier: Apache-2.0
#include "model/linear_profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace skyfit {

LinearProfile::LinearProfile(std::vector<double> heights, std::vector<double> densities)
    : heights_(std::move(heights)), densities_(std::move(densities)), column_below_{0} {
  for (std::size_t i = 0; i + 1 < heights_.size(); ++i) {
    column_below_.push_back(column_below_.back() + 0.5 * (densities_[i] + densities_[i + 1]) *
                                                       (heights_[i + 1] - heights_[i]));
  }
}

double LinearProfile::density(double height) const {
  if (height > heights_.back()) return 0;
  const auto above = std::lower_bound(heights_.begin(), heights_.end(), height);
  const auto i = static_cast<std::size_t>(above - heights_.begin());
  return i == 0 ? densities_.front() : density_in(i - 1, height);
}

double LinearProfile::height_below(double share) const {
  const double below = (1 - share) * vertical_column();
  const auto last = column_below_.end() - 1;
  const auto at =
      std::min(std::upper_bound(column_below_.begin(), column_below_.end(), below), last);
  const auto i = static_cast<std::size_t>(at - column_below_.begin()) - 1;
  // d0 x + (d1 - d0) x^2 / (2 l) = rest, in the form that does not cancel.
  const double length = heights_[i + 1] - heights_[i], rest = below - column_below_[i];
  const double d0 = densities_[i], slope = (densities_[i + 1] - d0) / length;
  const double root = std::sqrt(std::max(d0 * d0 + 2 * slope * rest, 0.0));
  return heights_[i] + (rest > 0 ? std::min(2 * rest / (d0 + root), length) : 0.0);
}

}  // namespace skyfit
