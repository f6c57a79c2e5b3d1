// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/regional_map.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "model/base/module_file.h"
#include "model/numerics/angles.h"
#include "render/gl/terrain/blend.h"
#include "render/gl/terrain/cubic_spline.h"

namespace skyfit {
namespace {

constexpr double kEdgeShare = 0.1;  // of a map's shorter side, where the scene states no edge
constexpr double kSeaDepth = 1;     // m, where a cell without data is sea

constexpr double kLeastCosine = 0.01;  // of the middle latitude of a map about a pole
constexpr float kMissing = std::numeric_limits<float>::quiet_NaN();

}  // namespace

GeographicPlace place_of(const glm::dvec3& direction) {
  return {std::atan2(direction.z, std::hypot(direction.x, direction.y)),
          std::atan2(direction.y, direction.x)};
}

RegionalMap::RegionalMap(const Scene& scene, const RegionalDem& dem, double bottom_radius_m,
                         std::int64_t most_cells)
    : radius_m_(bottom_radius_m) {
  const auto& module = module_named<DemModule>("skyfit_dem_module");
  DemCells cells = module.read(dem.file, dem.band, kFewestDemCells, most_cells);
  west_ = cells.west_deg * kRadiansPerDegree;
  north_ = cells.north_deg * kRadiansPerDegree;
  column_ = cells.column_deg * kRadiansPerDegree;
  row_ = cells.row_deg * kRadiansPerDegree;
  around_ = cells.columns * cells.column_deg > 360 - 0.5 * cells.column_deg;
  const double down_m = row_ * radius_m_;
  const double along_m =
      column_ * radius_m_ * std::max(std::cos(north_ - 0.5 * cells.rows * row_), kLeastCosine);
  cell_m_ = std::sqrt(down_m * along_m);
  narrow_m_ = std::min(down_m, along_m);
  const double stated = scene.dem_edge_m.value_or(
      kEdgeShare * std::min(cells.rows * down_m, cells.columns * along_m));
  edge_m_ = std::max(stated, narrow_m_);
  set_heights(scene, dem, cells);
  set_distances(cells, module);
  levels_.push_back({cells.columns, cells.rows, std::move(cells.heights_m)});
  add_coarser_levels();
  fill_gaps();
}

// Above the bottom radius; gaps that are sea are closed.
void RegionalMap::set_heights(const Scene& scene, const RegionalDem& dem, DemCells& cells) {
  const bool has_sea = scene.dem_surroundings == DemSurroundings::kSea;
  lowest_m_ = std::numeric_limits<double>::infinity();
  highest_m_ = -lowest_m_;
  for (float& height : cells.heights_m) {
    if (std::isnan(height)) {
      if (!has_sea) continue;
      height = static_cast<float>(scene.water_level_m - kSeaDepth);
    } else {
      height += static_cast<float>(dem.zero_m);
    }
    lowest_m_ = std::min<double>(lowest_m_, height);
    highest_m_ = std::max<double>(highest_m_, height);
  }
}

// A gap that data enclose is closed from its edge; one that reaches the edge of the map is beyond
// it.
void RegionalMap::set_distances(const DemCells& cells, const DemModule& module) {
  const auto is_gap = [&](std::size_t cell) { return std::isnan(cells.heights_m[cell]); };
  const auto columns = static_cast<std::size_t>(cells.columns);
  const std::size_t count = cells.heights_m.size();
  std::vector<std::uint8_t> known(count, 1);
  std::vector<std::size_t> open;
  const auto reach = [&](std::size_t cell) {
    if (known[cell] == 0 || !is_gap(cell)) return;
    known[cell] = 0;
    open.push_back(cell);
  };
  for (std::size_t cell = 0; cell < count; ++cell) {
    const std::size_t column = cell % columns;
    const bool at_side = !around_ && (column == 0 || column + 1 == columns);
    if (at_side || cell < columns || cell + columns >= count) reach(cell);
  }
  has_gaps_ = std::ranges::any_of(cells.heights_m, [](float h) { return std::isnan(h); });
  if (open.empty()) return;
  while (!open.empty()) {
    const std::size_t cell = open.back(), column = cell % columns;
    open.pop_back();
    if (column > 0) reach(cell - 1);
    if (column + 1 < columns) reach(cell + 1);
    if (cell >= columns) reach(cell - columns);
    if (cell + columns < count) reach(cell + columns);
  }
  distances_ = module.distances(cells.columns, cells.rows, known, edge_m_ / narrow_m_);
}

// Means of four cells each, of those that have data.
void RegionalMap::add_coarser_levels() {
  while (std::min(levels_.back().columns, levels_.back().rows) >= 2 * kFewestDemCells) {
    const Level& fine = levels_.back();
    Level coarse{(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}};
    coarse.heights_m.resize(static_cast<std::size_t>(coarse.columns) * coarse.rows);
    tbb::parallel_for(0, coarse.rows, [&](int row) {
      for (int column = 0; column < coarse.columns; ++column) {
        double sum = 0;
        int count = 0;
        for (const int y : {2 * row, 2 * row + 1}) {
          for (const int x : {2 * column, 2 * column + 1}) {
            const double height = extended(fine, x, y);
            if (std::isnan(height)) continue;
            sum += height;
            ++count;
          }
        }
        coarse.at(column, row) = count > 0 ? static_cast<float>(sum / count) : kMissing;
      }
    });
    levels_.push_back(std::move(coarse));
  }
}

// From the coarser level, and the coarsest one from its mean: the farther from data, the smoother.
void RegionalMap::fill_gaps() {
  if (!has_gaps_) return;
  double sum = 0;
  int count = 0;
  for (const float height : levels_.back().heights_m) {
    if (std::isnan(height)) continue;
    sum += height;
    ++count;
  }
  for (float& height : levels_.back().heights_m)
    if (std::isnan(height)) height = static_cast<float>(sum / count);
  for (std::size_t k = levels_.size() - 1; k-- > 0;) {
    Level& level = levels_[k];
    tbb::parallel_for(0, level.rows, [&](int row) {
      for (int column = 0; column < level.columns; ++column) {
        float& height = level.at(column, row);
        if (!std::isnan(height)) continue;
        const auto [mean, square] =
            sums_of(levels_[k + 1], 0.5 * (column + 0.5), 0.5 * (row + 0.5));
        height = static_cast<float>(std::clamp(mean, lowest_m_, highest_m_));
      }
    });
  }
}

GeographicPlace RegionalMap::centre() const {
  const Level& finest = levels_.front();
  return {north_ - 0.5 * finest.rows * row_,
          std::remainder(west_ + 0.5 * finest.columns * column_, 2 * std::numbers::pi)};
}

void RegionalMap::add_inputs(CacheKey& key) const {
  const Level& finest = levels_.front();
  key.text("regional map").value(west_).value(north_).value(column_).value(row_).value(edge_m_);
  key.value(finest.columns).value(finest.rows).value(distances_.empty());
  for (const std::vector<float>* values : {&finest.heights_m, &distances_})
    key.text({reinterpret_cast<const char*>(values->data()), values->size() * sizeof(float)});
}

RegionalMap::Spot RegionalMap::spot_of(const GeographicPlace& place) const {
  const Level& finest = levels_.front();
  const double columns = finest.columns, rows = finest.rows;
  const double from_centre =
      std::remainder(place.longitude - centre().longitude, 2 * std::numbers::pi);
  const double u = 0.5 * columns + from_centre / column_, v = (north_ - place.latitude) / row_;
  const double along_m = (u - std::clamp(u, 0.0, columns)) * column_ * radius_m_;
  const double down_m = (v - std::clamp(v, 0.0, rows)) * row_ * radius_m_;
  Spot spot{u, std::clamp(v, -1.0, rows + 1), std::abs(down_m), std::min(v, rows - v)};
  if (!around_) {
    spot.u = std::clamp(u, -1.0, columns + 1);
    spot.beyond_m = std::hypot(along_m * std::cos(place.latitude), down_m);
    spot.inside = std::min({spot.inside, u, columns - u});
  }
  if (spot.beyond_m > 0) spot.inside = -spot.beyond_m / narrow_m_;
  return spot;
}

std::optional<RegionalMap::Sample> RegionalMap::at(const GeographicPlace& place,
                                                   double resolution_m) const {
  const Spot spot = spot_of(place);
  if (spot.beyond_m >= edge_m_) return std::nullopt;
  const double gap = distances_.empty() ? 0 : gap_distance(spot.u, spot.v);  // cells
  const double beyond = spot.beyond_m + gap * narrow_m_;
  if (beyond >= edge_m_) return std::nullopt;
  const auto [height, slope] = height_and_slope(spot, std::max(resolution_m, beyond));
  return Sample{std::clamp(height, lowest_m_, highest_m_), slope,
                smoothstep(-1, 1, std::min(spot.inside, 1 - 2 * gap)),
                1 - smoothstep(0, edge_m_, beyond)};
}

// Linear between the cells.
double RegionalMap::gap_distance(double u, double v) const {
  const Level& finest = levels_.front();
  const double x = std::clamp(u - 0.5, 0.0, finest.columns - 1.0);
  const double y = std::clamp(v - 0.5, 0.0, finest.rows - 1.0);
  const auto column = std::min(static_cast<int>(x), finest.columns - 2);
  const auto row = std::min(static_cast<int>(y), finest.rows - 2);
  const auto at = [&](int c, int r) {
    return static_cast<double>(distances_[static_cast<std::size_t>(r) * finest.columns + c]);
  };
  return std::lerp(std::lerp(at(column, row), at(column + 1, row), x - column),
                   std::lerp(at(column, row + 1), at(column + 1, row + 1), x - column), y - row);
}

std::pair<double, double> RegionalMap::height_and_slope(const Spot& spot,
                                                        double resolution_m) const {
  // The shortest wave between cells is two of them long.
  const double cells = std::max(0.5 * resolution_m / cell_m_, 1.0);
  const double level = std::min(std::log2(cells), static_cast<double>(levels_.size() - 1));
  const auto fine = static_cast<std::size_t>(level);
  const double size = std::exp2(static_cast<double>(fine));
  const auto [mean, square] = sums_of(levels_[fine], spot.u / size, spot.v / size);
  const double slope = spline_slope(mean, square) / size;
  const double part = level - static_cast<double>(fine);
  if (part <= 0) return {mean, slope};
  const auto [coarse, coarse_square] =
      sums_of(levels_[fine + 1], 0.5 * spot.u / size, 0.5 * spot.v / size);
  // Both of them: the coarser level reaches farther out to sea.
  return {std::lerp(mean, coarse, part),
          std::lerp(slope, spline_slope(coarse, coarse_square) / (2 * size), part)};
}

// The weighted means of heights and of their squares; gaps of the coarser levels are filled.
std::pair<double, double> RegionalMap::sums_of(const Level& level, double u, double v) const {
  const CubicSpline along(u), down(v);
  double sum = 0, square = 0;
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      const double height = extended(level, along.first + x, down.first + y);
      const double weight =
          along.weight[static_cast<std::size_t>(x)] * down.weight[static_cast<std::size_t>(y)];
      sum += weight * height;
      square += weight * height * height;
    }
  }
  return {sum, square};
}

// Beyond the edge a ramp goes on.
double RegionalMap::extended(const Level& level, int column, int row) const {
  const int right = level.columns - 1, lowest = level.rows - 1;
  if (around_) column = (column + 2 * level.columns) % level.columns;
  const int c = std::clamp(column, 0, right), r = std::clamp(row, 0, lowest);
  const double edge = level.at(c, r);
  double height = edge;
  if (column != c) height += std::abs(column - c) * (edge - level.at(c == 0 ? 1 : right - 1, r));
  if (row != r) height += std::abs(row - r) * (edge - level.at(c, r == 0 ? 1 : lowest - 1));
  return height;
}

}  // namespace skyfit
