// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/linear_profile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace skyfit {
namespace {

std::optional<TableFault> profile_fault(const TwoColumns& table) {
  if (auto fault = ascending_fault(kProfileFormat, table, 0)) return fault;
  // Every row is looked at for every ray of the solver: 2000 cost seconds.
  constexpr std::size_t kMostRows = 2000;
  if (table.x.size() > kMostRows)
    return TableFault{
        0, {}, fmt::format("{} values", table.x.size()), fmt::format("at most {}", kMostRows)};
  for (std::size_t i = 0; i < table.y.size(); ++i) {
    if (!(table.y[i] >= 0) || !std::isfinite(table.y[i])) {
      return TableFault{1, i, {}, "a density >= 0"};
    }
  }
  if (std::ranges::count(table.y, 0.0) == static_cast<std::ptrdiff_t>(table.y.size())) {
    return TableFault{1, {}, "only zeros", "a density > 0 somewhere"};
  }
  return {};
}

}  // namespace

const TableFormat kProfileFormat{{"height_m", "relative_density"}, profile_fault};

LinearProfile::LinearProfile(TwoColumns table) : LinearProfile(std::move(table), Unchecked{}) {
  expect_no_fault(kProfileFormat, table_);
}

LinearProfile::LinearProfile(TwoColumns table, Unchecked)
    : table_(std::move(table)), column_below_{0} {
  if (table_.x.size() != table_.y.size()) return;  // which is a fault
  for (std::size_t i = 0; i + 1 < heights().size(); ++i) {
    column_below_.push_back(column_below_.back() + 0.5 * (densities()[i] + densities()[i + 1]) *
                                                       (heights()[i + 1] - heights()[i]));
  }
}

double LinearProfile::density(double height) const {
  if (height > heights().back()) return 0;
  const auto above = std::lower_bound(heights().begin(), heights().end(), height);
  const auto i = static_cast<std::size_t>(above - heights().begin());
  return i == 0 ? densities().front() : density_in(i - 1, height);
}

double LinearProfile::mean_density(double low, double height, double high) const {
  static constexpr double kNode[2] = {0.2113248654051871, 0.7886751345948129};  // Gauss, on 0 .. 1
  double sum = 0;
  const auto add = [&](std::size_t piece, double zero, double one) {  // where the weight is so
    const double from = std::max(heights()[piece], std::min(zero, one));
    const double to = std::min(heights()[piece + 1], std::max(zero, one));
    if (!(from < to)) return;
    for (const double node : kNode) {  // exact for the product of two linear functions
      const double h = from + node * (to - from);
      sum += 0.5 * (to - from) * density_in(piece, h) * (h - zero) / (one - zero);
    }
  };
  for (std::size_t i = 0; i + 1 < heights().size(); ++i) {
    add(i, low, height);
    add(i, high, height);
  }
  return sum / (0.5 * (high - low));
}

double LinearProfile::height_below(double share) const {
  const double below = (1 - share) * vertical_column();
  const auto last = column_below_.end() - 1;
  const auto at =
      std::min(std::upper_bound(column_below_.begin(), column_below_.end(), below), last);
  const auto i = static_cast<std::size_t>(at - column_below_.begin()) - 1;
  // d0 x + slope x^2 / 2 = rest, in the form that does not cancel.
  const double length = heights()[i + 1] - heights()[i], rest = below - column_below_[i];
  const double d0 = densities()[i], slope = (densities()[i + 1] - d0) / length;
  const double root = std::sqrt(std::max(d0 * d0 + 2 * slope * rest, 0.0));
  return heights()[i] + (rest > 0 ? std::min(2 * rest / (d0 + root), length) : 0.0);
}

}  // namespace skyfit
