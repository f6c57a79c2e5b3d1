// SPDX-License-Identifier: Apache-2.0
// What is finer than a map of heights: noise that is rougher where the map is steeper. It adds no
// height on average.
#pragma once

#include <glm/vec3.hpp>

namespace skyfit {

struct MapScale {
  double texel_m;  // between neighbouring texels
  double range_m;  // of the map's heights
};

// In metres, at `position_m` from the planet's centre; waves shorter than `resolution_m` are left
// out. `slope_m`: of the map, per texel. Under water there is no roughness of flat land, so that a
// sea that the map shows as flat stays one.
double detail_m(const MapScale& scale, const glm::dvec3& position_m, double slope_m,
                double above_water_m, double resolution_m);

// Elevation::above_water_m of ground `bed_m` above the water's level. A map without depths shows
// water as flat: its coast then lies half a texel, or half of what `resolution_m` still shows,
// before the land that rises from it, and not at the last texel of water.
double above_water_m(double bed_m, bool has_depths, const MapScale& scale, double slope_m,
                     double resolution_m);

// A bound on detail_m().
double most_detail_m(const MapScale& scale);

}  // namespace skyfit
