// SPDX-License-Identifier: Apache-2.0
#include "model/geometry/ray.h"

#include <algorithm>
#include <cmath>

#include "model/numerics/gauss.h"
#include "model/shared/shared.h"

namespace skyfit {
namespace {
Shared<double> shared;  // stateless
}

// docs/theory (1.4) to (1.7).
ViewRay view_ray(double bottom_radius, double top, double altitude, double mu) {
  ViewRay ray;
  double height = altitude, cosine = mu;
  if (altitude > top) {
    if (mu >= 0 || shared.sphere_discriminant(bottom_radius, altitude, mu, top) <= 0) return ray;
    ray.entry_distance = shared.distance_to_inner_sphere(bottom_radius, altitude, mu, top);
    height = top;
    cosine = ((bottom_radius + altitude) * mu + ray.entry_distance) / (bottom_radius + top);
  }
  ray.entry_height = height;
  ray.entry_mu = cosine;
  const double r = bottom_radius + height;
  ray.hits_ground = cosine < 0 && shared.sphere_discriminant(bottom_radius, height, cosine, 0) >= 0;
  if (ray.hits_ground) {
    ray.length = shared.distance_to_inner_sphere(bottom_radius, height, cosine, 0);
    ray.tangent_s = ray.length;
    ray.tangent_height = 0;
    return ray;
  }
  ray.length = shared.distance_to_outer_sphere(bottom_radius, height, cosine, top);
  ray.tangent_s = std::min(std::max(-r * cosine, 0.0), ray.length);
  ray.tangent_height = shared.height_after(bottom_radius, height, cosine, ray.tangent_s);
  return ray;
}

// docs/theory (1.1) and (1.2).
RayPoint ray_point(const ViewRay& ray, double bottom_radius, double s) {
  const double h =
      std::max(shared.height_after(bottom_radius, ray.entry_height, ray.entry_mu, s), 0.0);
  return {s, h, std::clamp(ray.radius_mu_at(s, bottom_radius) / (bottom_radius + h), -1.0, 1.0)};
}

std::vector<double> shell_crossings(const ViewRay& ray, double bottom_radius,
                                    const std::vector<double>& heights) {
  std::vector<double> s = {0};
  auto crossing_down = [&](double h) {
    return shared.distance_to_inner_sphere(bottom_radius, ray.entry_height, ray.entry_mu, h);
  };
  auto crossing_up = [&](double h) {
    return shared.distance_to_outer_sphere(bottom_radius, ray.entry_height, ray.entry_mu, h);
  };
  if (ray.tangent_s > 0) {
    for (auto h = heights.rbegin(); h != heights.rend(); ++h) {
      if (*h<ray.entry_height&& * h> ray.tangent_height) s.push_back(crossing_down(*h));
    }
    s.push_back(ray.tangent_s);
  }
  if (!ray.hits_ground) {
    const double from = ray.tangent_s > 0 ? ray.tangent_height : ray.entry_height;
    for (const double h : heights) {
      if (h <= from) continue;
      const double up = crossing_up(h);
      if (up < ray.length) s.push_back(up);
    }
    s.push_back(ray.length);
  }
  std::sort(s.begin(), s.end());
  s.erase(std::unique(s.begin(), s.end()), s.end());
  return s;
}

std::vector<double> with_piece_breaks(const std::vector<double>& breaks) {
  std::vector<double> all = {breaks.front()};
  for (std::size_t i = 1; i < breaks.size(); ++i)
    for_pieces(breaks[i - 1], breaks[i], [&](double, double end) { all.push_back(end); });
  return all;
}

std::vector<QuadratureNode> composite_gauss(const std::vector<double>& breaks, int order) {
  const GaussRule rule = gauss_legendre(order);
  std::vector<QuadratureNode> nodes;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double length = breaks[i + 1] - breaks[i];
    if (length == 0) continue;
    for (int k = 0; k < order; ++k)
      nodes.push_back({breaks[i] + length * rule.node[k], length * rule.weight[k]});
  }
  return nodes;
}

}  // namespace skyfit
