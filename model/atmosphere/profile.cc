// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/profile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>

#include "model/shared/shared.h"

namespace skyfit {
namespace {

// A corner of a layer and how it moves with the base and the top.
struct Corner {
  double height, density;
  std::array<double, 2> by;
};

// docs/theory (2.5).
std::vector<Corner> layer_corners(double base, double top) {
  constexpr double kHalf = 0.5 * kLayerEdge;
  const double half = kHalf * (top - base);
  std::vector<Corner> corners;
  if (base >= half) {
    corners = {{base - half, 0, {1 + kHalf, -kHalf}}, {base + half, 1, {1 - kHalf, kHalf}}};
  } else if (base > 0) {  // the edge is as wide as the ground allows
    corners = {{0, 0, {}}, {2 * base, 1, {2, 0}}};
  } else {
    corners = {{0, 1, {}}};
  }
  corners.push_back({top - half, 1, {kHalf, 1 - kHalf}});
  corners.push_back({top + half, 0, {-kHalf, 1 + kHalf}});
  return corners;
}

TabulatedProfile layer_table(const std::vector<Corner>& corners) {
  TwoColumns table;
  if (corners.front().height > 0) table = {{0}, {0}};
  for (const Corner& corner : corners) {
    table.x.push_back(corner.height);
    table.y.push_back(corner.density);
  }
  return std::make_shared<const LinearProfile>(std::move(table));
}

// docs/theory (2.6).
// On a line whose ends move: d rho / dp = -slope times the speed there, linear between them.
TabulatedProfile layer_by_shape(const std::vector<Corner>& corners, std::size_t shape) {
  TwoColumns table{{0, corners.front().height}, {0, 0}};
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const Corner &low = corners[i], &high = corners[i + 1];
    const double slope = (high.density - low.density) / (high.height - low.height);
    for (const Corner* corner : {&low, &high}) {
      table.x.push_back(corner->height);
      table.y.push_back(-slope * corner->by[shape]);
    }
  }
  return std::make_shared<const LinearProfile>(LinearProfile::of_any_sign(std::move(table)));
}

ByShape shapes_of(const std::vector<TabulatedProfile>& tables, auto value) {
  ByShape result{};
  for (std::size_t s = 0; s < tables.size(); ++s) result[s] = value(*tables[s]);
  return result;
}

}  // namespace

Profile::Profile(const VerticalProfile<double>& profile) {
  switch (profile.type) {
    case ProfileType::kExponential:
      scale_height_ = profile.scale_height_m;
      return;
    case ProfileType::kCorners:
      table_ = std::make_shared<const LinearProfile>(
          corner_profiles()[profile.corners].corners(profile.numbers));
      return;
    case ProfileType::kLayer: {
      base_ = profile.base_m;
      top_ = profile.top_m;
      edge_ = 0.5 * kLayerEdge * (top_ - base_);
      const std::vector<Corner> corners = layer_corners(base_, top_);
      table_ = layer_table(corners);
      for (std::size_t shape = 0; shape < 2; ++shape)
        by_shape_.push_back(layer_by_shape(corners, shape));
      return;
    }
    case ProfileType::kTabulated:
      table_ = profile.table;
      return;
    case ProfileType::kSameAs:
    case ProfileType::kSquareOf:
      throw std::logic_error("Profile: one that is that of another has no shape of its own");
  }
}

Profile Profile::with_tables(std::vector<LinearProfile> tables,
                             const std::function<double(double)>& moved) const {
  Profile result = *this;
  result.by_shape_.clear();
  for (LinearProfile& table : tables)
    result.by_shape_.push_back(std::make_shared<const LinearProfile>(std::move(table)));
  result.table_ = result.by_shape_.front();
  result.by_shape_.erase(result.by_shape_.begin());
  if (is_layer()) {
    result.base_ = moved(base_);
    result.top_ = moved(top_);
  }
  return result;
}

namespace {

constexpr double kOutside = 0.005;  // share of the column

bool same_table(const TabulatedProfile& a, const TabulatedProfile& b) {
  return a == b || (a && b && a->table() == b->table());
}

}  // namespace

bool operator==(const Profile& a, const Profile& b) {
  return a.scale_height_ == b.scale_height_ && a.base_ == b.base_ && a.top_ == b.top_ &&
         same_table(a.table_, b.table_) && std::ranges::equal(a.by_shape_, b.by_shape_, same_table);
}

double Profile::bulk_thickness() const {
  return table_->height_below(kOutside) - table_->height_below(1 - kOutside);
}

void Profile::take_as_layer() {
  base_ = table_->height_below(1 - kOutside);
  top_ = table_->height_below(kOutside);
}

Density Profile::density(double height) const {
  if (table_) {
    return {table_->density(height),
            shapes_of(by_shape_, [&](const LinearProfile& t) { return t.density(height); })};
  }
  const double value = Shared<double>{}.exponential_density(height, scale_height_);
  return {value, {value * height / (scale_height_ * scale_height_)}};
}

// docs/theory (2.7).
Density Profile::density_at_level(double low, double height, double high) const {
  if (!table_) return density(height);
  const auto mean = [&](const LinearProfile& t) { return t.mean_density(low, height, high); };
  return {mean(*table_), shapes_of(by_shape_, mean)};
}

Column Profile::column_to_top(double bottom_radius, double height, double mu, double top) const {
  if (!table_) return exponential_column(bottom_radius, height, mu, top, scale_height_);
  const auto column = [&](const LinearProfile& t) {
    return linear_column(t, bottom_radius, height, mu, top);
  };
  return {column(*table_), shapes_of(by_shape_, column)};
}

// docs/theory (2.2).
Column Profile::vertical_column() const {
  if (!table_) return {scale_height_, {1}};
  const auto column = [](const LinearProfile& t) { return t.vertical_column(); };
  return {column(*table_), shapes_of(by_shape_, column)};
}

std::vector<double> Profile::quadrature_heights() const {
  std::vector<double> heights;
  if (is_layer()) {
    // Denser toward both ends: light that comes out of a thick layer is scattered there.
    for (const double x : {0.0, 0.01, 0.03, 0.07, 0.13, 0.2, 0.3, 0.4, 0.5}) {
      heights.push_back(base_ + x * (top_ - base_));
      heights.push_back(top_ - x * (top_ - base_));
    }
    heights.insert(heights.end(), table_->heights().begin(), table_->heights().end());
    std::sort(heights.begin(), heights.end());
    return heights;
  }
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

// docs/theory (3.2).
std::vector<double> Profile::level_heights(double optical_depth) const {
  if (!is_layer()) return {};
  // The source of a level to the next is linear in optical depth: near both ends, where light falls
  // in and out, a step has at most a sixth of one, then twice as much every twelve levels.
  constexpr double kFewest = 16, kMost = 512, kPerDepth = 6;
  constexpr int kEvery = 12;
  const double steps = std::clamp(
      std::exp2(std::ceil(std::log2(std::max(kPerDepth * optical_depth, 1.0)))), kFewest, kMost);
  const double step = std::exp2(std::floor(std::log2((top_ - base_) / steps)));  // m
  const auto first = static_cast<long>(std::lround(std::max(base_ - edge_, 0.0) / step)),
             last = static_cast<long>(std::lround((top_ + edge_) / step));
  std::set<long> levels;
  long stride = 1, inside = -1;
  for (int n = 0; first + inside <= (first + last) / 2; ++n) {
    levels.insert(first + inside);
    levels.insert(last - inside);
    if (n > 0 && n % kEvery == 0) stride *= 2;
    inside += stride;
  }
  std::vector<double> heights;
  for (const long k : levels) {
    if (k > 0) heights.push_back(static_cast<double>(k) * step);
  }
  return heights;
}

}  // namespace skyfit
