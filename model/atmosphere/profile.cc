// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/profile.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "model/shared/shared.h"

namespace skyfit {

Density Profile::density(double height) const {
  if (table_) return {table_->density(height), 0};
  const double value = Shared<double>{}.exponential_density(height, scale_height_);
  return {value, value * height / (scale_height_ * scale_height_)};
}

Density Profile::density_at_level(double low, double height, double high) const {
  return table_ ? Density{table_->mean_density(low, height, high), 0} : density(height);
}

Column Profile::column_to_top(double bottom_radius, double height, double mu, double top) const {
  if (table_) return {linear_column(*table_, bottom_radius, height, mu, top), 0};
  return exponential_column(bottom_radius, height, mu, top, scale_height_);
}

Column Profile::vertical_column() const {
  return table_ ? Column{table_->vertical_column(), 0} : Column{scale_height_, 1};
}

std::vector<double> Profile::quadrature_heights() const {
  std::vector<double> heights;
  // In scale heights of an exponential profile.
  for (const double part : {0.0, 0.25, 0.6, 1.0, 1.7, 2.5, 4.0, 7.0}) {
    heights.push_back(table_ ? table_->height_below(std::exp(-part)) : part * scale_height_);
  }
  for (std::size_t i = 0; table_ && i < table_->heights().size(); ++i) {
    if (table_->densities()[i] == 0) heights.push_back(table_->heights()[i]);
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

TabulatedProfile ozone_tent() {
  static const auto kTent =
      std::make_shared<const LinearProfile>(TwoColumns{{0, 10e3, 25e3, 40e3}, {0, 0, 1, 0}});
  return kTent;
}

}  // namespace skyfit
