// SPDX-License-Identifier: Apache-2.0
// A straight ray through spherical shells: where it runs, and nodes of a quadrature along it.
// Lengths in metres.
#pragma once

#include <algorithm>
#include <vector>

namespace skyfit {

// The part of a line of sight that lies inside the atmosphere. s is the distance from the ray's
// entry.
struct ViewRay {
  double entry_height = 0, entry_mu = 0;  // where the ray begins inside the atmosphere
  double entry_distance = 0;              // from the observer to there; 0 inside
  double length = 0;                      // 0: the ray misses the atmosphere
  bool hits_ground = false;
  double tangent_s = 0;       // where the height is least, in 0 .. length
  double tangent_height = 0;  // that height

  double radius_mu_at(double s, double bottom_radius) const {  // r mu at s
    return (bottom_radius + entry_height) * entry_mu + s;
  }
};
ViewRay view_ray(double bottom_radius, double top, double altitude, double mu);

struct RayPoint {
  double s, height, mu;
};
RayPoint ray_point(const ViewRay& ray, double bottom_radius, double s);

// docs/theory (1.16).
// Columns from the ray's entry to the point, of any type with +=, unary - and {} for none:
// to_top(height, mu), mu >= 0, is that from a point upward.
template <class ToTop>
auto columns_along(const ToTop& to_top, double bottom_radius, const ViewRay& ray,
                   const RayPoint& point) {
  using Columns = decltype(to_top(0.0, 0.0));
  if (point.s <= 0) return Columns{};
  const bool entry_descends = ray.tangent_s > 0, point_descends = point.s < ray.tangent_s;
  if (!entry_descends) {  // both look up
    Columns c = to_top(ray.entry_height, ray.entry_mu);
    return c += -to_top(point.height, std::max(point.mu, 0.0));
  }
  if (point_descends) {  // both look down: seen from the other end
    Columns c = to_top(point.height, std::max(-point.mu, 0.0));
    return c += -to_top(ray.entry_height, -ray.entry_mu);
  }
  // Down to the lowest point, then up.
  const double lowest_mu = ray.hits_ground ? -ray_point(ray, bottom_radius, ray.length).mu : 0;
  Columns c = to_top(ray.tangent_height, lowest_mu);
  Columns up = c;
  c += -to_top(ray.entry_height, -ray.entry_mu);
  if (point.s > ray.tangent_s) c += (up += -to_top(point.height, std::max(point.mu, 0.0)));
  return c;
}

// Where the ray crosses the shells of the given ascending heights, with its ends and its lowest
// point, ascending in s.
std::vector<double> shell_crossings(const ViewRay& ray, double bottom_radius,
                                    const std::vector<double>& heights);

// docs/theory (1.17).
// The pieces of a quadrature from `begin` to `end` along a ray: in thick air, where two shells lie
// many mean free paths apart along the horizon, the light comes from the nearest of them. A piece
// is at most as long as its distance from the eye, or 500 m where that is more: over 500 m the
// standard aerosol at its bounds has an optical depth of 1.7. Calls piece(begin, end) in order.
template <class Piece>
void for_pieces(double begin, double end, Piece&& piece) {
  constexpr double kNearest = 500;  // m
  while (begin < end) {
    const double next = std::min(end, begin + std::max(begin, kNearest));
    piece(begin, next);
    begin = next;
  }
}

// The breaks (ascending) and those of the pieces between them.
std::vector<double> with_piece_breaks(const std::vector<double>& breaks);

struct QuadratureNode {
  double s, weight;
};
// Gauss's rule of `order` nodes between each two neighbours of `breaks` (ascending; equal ones
// count once).
std::vector<QuadratureNode> composite_gauss(const std::vector<double>& breaks, int order);

}  // namespace skyfit
