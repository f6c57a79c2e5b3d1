// SPDX-License-Identifier: Apache-2.0
// The heights of a region, from a digital elevation model (render/dem/dem_module.h): cubic
// B-splines between the cells, and coarser copies where details are left out. Geodetic latitudes
// are taken as those of the planet, which is a sphere here.
//
// Beyond its edge, and in gaps without data that reach the edge, the map goes on and becomes
// smoother, while its presence falls to 0. Gaps that data enclose are closed from their edges.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "model/base/content_cache.h"
#include "render/dem/dem_module.h"
#include "render/gl/terrain/map_detail.h"
#include "render/render.h"

namespace skyfit {

// In radians.
struct GeographicPlace {
  double latitude, longitude;
};
GeographicPlace place_of(const glm::dvec3& direction);

// The cells of all the maps of a scene together: 1.6 GB, a third more for the coarser copies.
inline constexpr std::int64_t kMostDemCells = 400'000'000;

inline constexpr int kFewestDemCells = 4;  // along each side: the reach of a spline

class RegionalMap {
 public:
  struct Sample {
    double height_m;  // above the bottom radius
    double slope_m;   // per cell
    double inside;    // 1 where there is data; over the two cells about the edge it falls to 0
    double presence;  // 1 where there is data; it falls to 0 over the scene's edge
  };

  // The file of `dem`, of at most `most_cells`. Throws as DemModule::read().
  RegionalMap(const Scene& scene, const RegionalDem& dem, double bottom_radius_m,
              std::int64_t most_cells);

  // Nothing where its presence is 0. Details smaller than `resolution_m` are left out.
  std::optional<Sample> at(const GeographicPlace& place, double resolution_m) const;

  MapScale scale() const { return {cell_m_, highest_m_ - lowest_m_}; }
  double lowest_m() const { return lowest_m_; }  // above the bottom radius
  double highest_m() const { return highest_m_; }
  GeographicPlace centre() const;
  std::int64_t cells() const { return std::int64_t{levels_[0].columns} * levels_[0].rows; }
  void add_inputs(CacheKey& key) const;

 private:
  struct Level {
    int columns, rows;
    std::vector<float> heights_m;  // [row][column]
    float& at(int column, int row) {
      return heights_m[static_cast<std::size_t>(row) * columns + column];
    }
    float at(int column, int row) const {
      return heights_m[static_cast<std::size_t>(row) * columns + column];
    }
  };
  // Of the map, the nearest to a place.
  struct Spot {
    double u, v;      // in cells from the outer corner; up to a cell beyond an edge
    double beyond_m;  // how far the place is from the map
    double inside;    // cells to the nearest edge; negative: beyond it
  };

  void set_heights(const Scene& scene, const RegionalDem& dem, DemCells& cells);
  void set_distances(const DemCells& cells, const DemModule& module);
  void add_coarser_levels();
  void fill_gaps();
  Spot spot_of(const GeographicPlace& place) const;
  double gap_distance(double u, double v) const;
  std::pair<double, double> height_and_slope(const Spot& spot, double resolution_m) const;
  std::pair<double, double> sums_of(const Level& level, double u, double v) const;
  double extended(const Level& level, int column, int row) const;

  double radius_m_, west_, north_, column_, row_;  // radians
  bool around_;                                    // once around the planet
  double cell_m_, narrow_m_, edge_m_;              // narrow: the shorter side of a cell
  double lowest_m_, highest_m_;
  std::vector<Level> levels_;
  bool has_gaps_ = false;
  std::vector<float> distances_;  // in cells, [row][column]; empty where no gap reaches the edge
};

}  // namespace skyfit
