// SPDX-License-Identifier: Apache-2.0
#include "model/reference_model.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <cmath>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "model/single_scattering.h"
#include "model/sky_solution.h"

namespace skyfit {
namespace {

void check(bool good, const char* name, double value, const char* expected) {
  if (!good)
    throw std::invalid_argument(
        fmt::format("reference model: {} = {:.9g}: must be {}", name, value, expected));
}

void check(const SkyPoint& p) {
  check(std::isfinite(p.altitude_m) && p.altitude_m >= 0, "altitude_m", p.altitude_m, ">= 0");
  check(p.sun_zenith >= 0 && p.sun_zenith <= std::numbers::pi, "sun zenith (rad)", p.sun_zenith,
        "in 0 .. pi");
  check(p.view_zenith >= 0 && p.view_zenith <= std::numbers::pi, "view zenith (rad)", p.view_zenith,
        "in 0 .. pi");
  check(std::isfinite(p.relative_azimuth), "relative azimuth (rad)", p.relative_azimuth, "finite");
}

// The distinct view rays of a list of points, and which ray each point takes.
struct ViewRays {
  std::vector<ViewPath> paths;
  std::vector<int> path_of_point;
};
ViewRays distinct_view_rays(const Shells& shells, const std::vector<double>& heights,
                            std::span<const SkyPoint> points) {
  ViewRays rays;
  std::map<std::pair<double, double>, int> known;
  for (const SkyPoint& p : points) {
    const auto [at, added] =
        known.try_emplace({p.altitude_m, p.view_zenith}, static_cast<int>(rays.paths.size()));
    if (added)
      rays.paths.push_back(view_path(shells, heights, p.altitude_m, std::cos(p.view_zenith)));
    rays.path_of_point.push_back(at->second);
  }
  return rays;
}

template <int N>
SkyValues solve(const Atmosphere<double>& atmosphere, std::span<const WavelengthNode> wavelengths,
                std::span<const SkyPoint> points, std::span<const Parameter> derivatives,
                const ReferenceOptions& options) {
  Shells shells = shells_of(atmosphere);
  for (const Parameter p : derivatives) shells.ozone |= p == Parameter::kOzoneColumn;
  const ViewRays rays =
      distinct_view_rays(shells, level_heights(shells.top, options.levels), points);
  std::vector<SunAlongRay> suns;
  std::vector<double> mu_s;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ViewPath& path = rays.paths[rays.path_of_point[i]];
    suns.emplace_back(shells.bottom_radius, path.ray, points[i]);
    for (const RayPoint& p : path.sun_points) mu_s.push_back(suns.back().mu_s(p));
  }
  const SkySolution<N> solution(atmosphere, wavelengths, derivatives, mu_s, options);

  const int n_points = static_cast<int>(points.size()),
            n_waves = static_cast<int>(wavelengths.size());
  const std::size_t slices = 1 + derivatives.size();
  std::vector<double> multiple(points.size() * wavelengths.size() * slices, 0.0);
  std::vector<PathWithSuns> bundles;
  for (const ViewPath& path : rays.paths) bundles.push_back({&path, {}});
  for (std::size_t i = 0; i < points.size(); ++i) {
    bundles[rays.path_of_point[i]].suns.push_back(
        {&suns[i], &multiple[i * wavelengths.size() * slices]});
  }
  const MultipleScattering<N> scattering = solution.multiple_scattering();
  constexpr int kAtOnce = MultipleScattering<N>::kPathsAtOnce;
  const int n_paths = static_cast<int>(bundles.size());
  tbb::parallel_for(0, (n_paths + kAtOnce - 1) / kAtOnce, [&](int i) {
    const std::size_t first = static_cast<std::size_t>(i) * kAtOnce;
    scattering.add(std::span(bundles).subspan(
        first, std::min<std::size_t>(kAtOnce, bundles.size() - first)));
  });
  SkyValues values{n_points, n_waves, static_cast<int>(derivatives.size()), {}, {}};
  values.value.resize(static_cast<std::size_t>(n_points) * n_waves);
  values.derivative.resize(values.value.size() * derivatives.size());
  Shared<double> shared;
  std::vector<RayNodes> nodes(rays.paths.size());
  tbb::parallel_for(0, n_paths,
                    [&](int i) { nodes[i] = ray_nodes(shells, rays.paths[i].ray, {}); });
  tbb::parallel_for(0, n_points, [&](int i) {
    const ViewPath& path = rays.paths[rays.path_of_point[i]];
    if (path.nodes.empty()) return;
    const std::vector<double> edges = suns[i].shadow_edges();
    RayNodes own;
    if (!edges.empty()) own = ray_nodes(shells, path.ray, edges);
    const RayNodes& along = edges.empty() ? nodes[rays.path_of_point[i]] : own;
    const SunlitNodes sunlit = sunlit_nodes(shells, along, suns[i]);
    for (int w = 0; w < n_waves; ++w) {
      const SingleScattering<N> single = single_scattering(solution.optics(w), along, sunlit);
      const double nu = suns[i].nu();
      const Dual<N> sum = single.air * shared.rayleigh_phase(solution.optics(w).depolarisation, nu) +
                          single.aerosol * aerosol_phase(solution.optics(w).phase, nu) +
                          solution.ground(path, suns[i], w);
      const std::size_t cell = static_cast<std::size_t>(i) * n_waves + w;
      values.value[cell] = sum.v + multiple[cell * slices];
      if constexpr (N > 0) {
        for (std::size_t p = 0; p < derivatives.size(); ++p) {
          values.derivative[(p * n_points + i) * n_waves + w] =
              sum.d[p] + multiple[cell * slices + 1 + p];
        }
      }
    }
  });
  return values;
}

}  // namespace

ReferenceModel::ReferenceModel(const ReferenceOptions& options) : options_(options) {
  check(options.streams >= 2, "streams", options.streams, ">= 2");
  check(options.moments >= 3 && options.moments <= 2 * options.streams, "moments", options.moments,
        "in 3 .. 2 streams");
  check(options.levels >= 4, "levels", options.levels, ">= 4");
  check(options.threads >= 1, "threads", options.threads, ">= 1");
  check(options.tolerance > 0, "tolerance", options.tolerance, "> 0");
}

SkyValues ReferenceModel::radiance(const Atmosphere<double>& atmosphere,
                                   std::span<const WavelengthNode> wavelengths,
                                   std::span<const SkyPoint> points,
                                   std::span<const Parameter> derivatives) const {
  validate(atmosphere);
  for (const SkyPoint& p : points) check(p);
  for (const Parameter p : derivatives) {
    if (!has_parameter(atmosphere, p)) {
      throw std::invalid_argument(fmt::format(
          "reference model: the atmosphere has no {} to differentiate by", parameter_info(p).name));
    }
  }
  tbb::task_arena arena(options_.threads);
  return arena.execute([&] {
    return derivatives.empty()
               ? solve<0>(atmosphere, wavelengths, points, derivatives, options_)
               : solve<kParameterCount>(atmosphere, wavelengths, points, derivatives, options_);
  });
}

}  // namespace skyfit
