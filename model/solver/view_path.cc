// SPDX-License-Identifier: Apache-2.0
#include "model/solver/view_path.h"

#include <algorithm>
#include <cmath>

#include "model/atmosphere/parameter_field.h"
#include "model/numerics/lagrange.h"
#include "model/shared/shared.h"
#include "model/solver/sun_grid.h"

namespace skyfit {
namespace {

bool has_layers(const Shells& shells) {
  return std::ranges::any_of(shells.profiles, [](const Profile& p) { return p.is_layer(); });
}

void set_interpolation(const std::vector<double>& node_s, bool layers, ViewPath::Sample& sample) {
  const int size = static_cast<int>(node_s.size());
  const int above = static_cast<int>(
      std::upper_bound(node_s.begin(), node_s.end(), sample.point.s) - node_s.begin());
  const int most = std::min(4, size);
  NodeRange range{std::clamp(above - 2, 0, size - most), most};
  if (layers) range = without_short_steps(node_s, std::clamp(above, 1, size - 1), range);
  sample.first = range.first;
  sample.count = range.count;
  lagrange_weights(&node_s[sample.first], sample.count, sample.point.s, sample.share);
}

// Crossings that nearly coincide with an end or the lowest point of the ray say nothing new and
// spoil the interpolation.
std::vector<double> without_near_pairs(const std::vector<double>& s, double lowest) {
  std::vector<double> kept = {s.front()};
  auto fixed = [&](std::size_t i) { return i == 0 || i + 1 == s.size() || s[i] == lowest; };
  constexpr double kLeastShare = 0.25;  // of the neighbouring distance
  for (std::size_t i = 1; i + 1 < s.size(); ++i) {
    const double left = s[i] - s[i - 1], right = s[i + 1] - s[i];
    const bool near = (fixed(i - 1) && left < kLeastShare * right) ||
                      (fixed(i + 1) && right < kLeastShare * left);
    if (fixed(i) || !near) kept.push_back(s[i]);
  }
  if (s.size() > 1) kept.push_back(s.back());
  return kept;
}

}  // namespace

PartOfRay part_with_own_suns(const Shells& shells, const ViewRay& ray) {
  constexpr double kShare = 0.45;
  const double lowest = ray.tangent_s > 0 ? ray.tangent_height : ray.entry_height;
  const double highest = lowest + kShare * shells.top;
  PartOfRay part{0, ray.length};
  Shared<double> shared;
  if (ray.tangent_s > 0 && ray.entry_height > highest) {
    part.begin = shared.distance_to_inner_sphere(shells.bottom_radius, ray.entry_height,
                                                 ray.entry_mu, highest);
  }
  if (!ray.hits_ground && highest < shells.top) {
    part.end = shared.distance_to_outer_sphere(shells.bottom_radius, ray.entry_height, ray.entry_mu,
                                               highest);
  }
  return part;
}

ViewPath view_path(const Shells& shells, const std::vector<double>& heights, double altitude,
                   double mu) {
  ViewPath path;
  path.ray = view_ray(shells.bottom_radius, shells.top, altitude, mu);
  if (path.ray.length <= 0) {
    if (path.ray.hits_ground) {  // the eye is on the ground and looks at it
      path.nodes = {ray_point(path.ray, shells.bottom_radius, 0)};
      path.sun_points = path.nodes;
    }
    return path;
  }
  const std::vector<double> s = without_near_pairs(
      shell_crossings(path.ray, shells.bottom_radius, heights), path.ray.tangent_s);
  for (const double x : s) path.nodes.push_back(ray_point(path.ray, shells.bottom_radius, x));
  const PartOfRay part = part_with_own_suns(shells, path.ray);
  for (const RayPoint& node : path.nodes) {
    path.sun_points.push_back(
        node.s >= part.begin && node.s <= part.end
            ? node
            : ray_point(path.ray, shells.bottom_radius, std::clamp(node.s, part.begin, part.end)));
  }
  const bool layers = has_layers(shells);
  const std::vector<double> breaks = with_piece_breaks(with_profile_breaks(shells, path.ray, s));
  for (const QuadratureNode& q : composite_gauss(breaks, 3)) {
    ViewPath::Sample sample{ray_point(path.ray, shells.bottom_radius, q.s), q.weight, {}};
    sample.columns = columns_along(shells, path.ray, sample.point);
    set_interpolation(s, layers, sample);
    path.samples.push_back(sample);
  }
  path.columns_to_end = columns_along(shells, path.ray, path.nodes.back());
  return path;
}

// docs/theory (8.5).
template <int N>
NodeWeights<N> node_weights(const Optics<N>& optics, const ViewPath& path) {
  NodeWeights<N> weights(optics.scatterers.size(), std::vector<Dual<N>>(path.nodes.size()));
  for (const ViewPath::Sample& sample : path.samples) {
    const Dual<N> tau = optics.scaled_optical_depth(sample.columns);
    const double t = std::exp(-tau.v);
    const Dual<N> transmitted = tau.chain(t * sample.weight, -t * sample.weight);
    const Densities<N> rho = optics.densities(sample.point.height);
    for (std::size_t s = 0; s < optics.scatterers.size(); ++s) {
      const Scatterer<N>& scatterer = optics.scatterers[s];
      const Dual<N> weight = transmitted * scatterer.scaled_scattering * rho[scatterer.profile];
      for (int k = 0; k < sample.count; ++k)
        weights[s][sample.first + k] += weight * sample.share[k];
    }
  }
  return weights;
}

template NodeWeights<0> node_weights<0>(const Optics<0>&, const ViewPath&);
template NodeWeights<kDerivativesAtOnce> node_weights<kDerivativesAtOnce>(
    const Optics<kDerivativesAtOnce>&, const ViewPath&);

}  // namespace skyfit
