// SPDX-License-Identifier: Apache-2.0
#include "model/solver/view_rays.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "model/numerics/angles.h"

namespace skyfit {

ViewRays distinct_view_rays(const Shells& shells, const std::vector<double>& heights,
                            std::span<const SkyPoint> points) {
  ViewRays rays;
  std::map<std::pair<double, double>, int> known;
  std::vector<const SkyPoint*> first;
  for (const SkyPoint& p : points) {
    const auto [at, added] =
        known.try_emplace({p.altitude_m, p.view_zenith}, static_cast<int>(first.size()));
    if (added) first.push_back(&p);
    rays.path_of_point.push_back(at->second);
  }
  rays.paths.resize(first.size());
  tbb::parallel_for(std::size_t{0}, first.size(), [&](std::size_t i) {
    rays.paths[i] =
        view_path(shells, heights, first[i]->altitude_m, std::cos(first[i]->view_zenith));
  });
  return rays;
}

SunsAlongRays suns_along_rays(const Shells& shells, const ViewRays& rays,
                              std::span<const SkyPoint> points, const LightTurns* turns) {
  SunsAlongRays suns;
  suns.along.reserve(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ViewPath& path = rays.paths[rays.path_of_point[i]];
    const SunAlongRay& sun =
        suns.along.emplace_back(shells.bottom_radius, path.ray, points[i], turns);
    if (path.sun_points.empty()) continue;
    SunRange range{1, -1};
    for (const RayPoint& p : path.sun_points) {
      const double mu_s = sun.mu_s(p);
      range = {std::min(range.lowest, mu_s), std::max(range.highest, mu_s)};
    }
    suns.needed.push_back(range);
  }
  return suns;
}

FieldsOf fields_of(const Shells& shells, const SkyPoint& point, const LightTurns* turns) {
  static const double kDeep = std::cos(94 * kRadiansPerDegree);
  constexpr double kLow = 80 * kRadiansPerDegree;
  constexpr int kPlaces = 16;  // along which the local sun moves by a degree or so
  const ViewRay ray =
      view_ray(shells.bottom_radius, shells.top, point.altitude_m, std::cos(point.view_zenith));
  const SunAlongRay sun(shells.bottom_radius, ray, point, turns);
  const PartOfRay part = part_with_own_suns(shells, ray);
  double lowest = 1;
  for (int k = 0; k <= kPlaces; ++k) {
    const double s = part.begin + k * (part.end - part.begin) / kPlaces;
    lowest = std::min(lowest, sun.mu_s(ray_point(ray, shells.bottom_radius, s)));
  }
  if (lowest < kDeep) return FieldsOf::kDeepTwilight;
  return is_extended(shells) && point.sun_zenith > kLow ? FieldsOf::kLowSuns : FieldsOf::kDay;
}

}  // namespace skyfit
