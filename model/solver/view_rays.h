// SPDX-License-Identifier: Apache-2.0
// The view rays of a list of points of the sky, and the suns along them.
#pragma once

#include <span>
#include <vector>

#include "model/geometry/sun_along_ray.h"
#include "model/solver/sky_solution.h"
#include "model/solver/view_path.h"

namespace skyfit {

// The distinct rays, and which of them each point takes.
struct ViewRays {
  std::vector<ViewPath> paths;
  std::vector<int> path_of_point;
};
ViewRays distinct_view_rays(const Shells& shells, const std::vector<double>& heights,
                            std::span<const SkyPoint> points);

// One sun per point, and the local suns that the multiple scattering along the rays needs: a range
// per ray that meets the atmosphere.
struct SunsAlongRays {
  std::vector<SunAlongRay> along;
  std::vector<SunRange> needed;
};
SunsAlongRays suns_along_rays(const Shells& shells, const ViewRays& rays,
                              std::span<const SkyPoint> points, const LightTurns* turns);

// The fields that a point takes, by the lowest sun along its ray and the sun of its eye. They are
// solved apart, so that a list of points gives what each gives alone.
FieldsOf fields_of(const Shells& shells, const SkyPoint& point, const LightTurns* turns);

}  // namespace skyfit
