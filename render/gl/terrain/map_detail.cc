// SPDX-License-Identifier: Apache-2.0
#include "render/gl/terrain/map_detail.h"

#include <algorithm>

#include "render/gl/terrain/blend.h"
#include "render/gl/terrain/noise.h"

namespace skyfit {
namespace {

constexpr double kLongestDetail = 3;  // texels: what the map's splines still show
constexpr double kDetailSlope = 0.3;  // of every octave of the noise, as a share of the map's
constexpr double kMostDetail = 0.05;  // of the map's range of heights
constexpr double kOctaves = 2.1;      // a bound on the sum of octaves of amplitudes 1, 1/2, ...
constexpr double kRoughness = 0.12;   // of flat land, m, at waves of kRough
constexpr double kRough = 9;

}  // namespace

double detail_m(const MapScale& scale, const glm::dvec3& position_m, double slope_m,
                double above_water_m, double resolution_m) {
  const double longest = kLongestDetail * scale.texel_m;
  double detail = 0;
  const double amplitude =
      std::min(kDetailSlope * kLongestDetail * slope_m, kMostDetail * scale.range_m);
  if (amplitude > 0) detail += amplitude * fractal_noise(position_m, longest, resolution_m);
  const double dry = smoothstep(0, 1, above_water_m);
  if (dry > 0 && resolution_m < 2 * kRough && kRough < longest)
    detail += dry * kRoughness * fractal_noise(position_m + glm::dvec3(31), kRough, resolution_m);
  return detail;
}

double above_water_m(double bed_m, bool has_depths, const MapScale& scale, double slope_m,
                     double resolution_m) {
  if (has_depths) return bed_m;
  return bed_m - 0.5 * slope_m * std::max(1.0, 0.5 * resolution_m / scale.texel_m);
}

double most_detail_m(const MapScale& scale) {
  return kOctaves * (kMostDetail * scale.range_m + kRoughness);
}

}  // namespace skyfit
