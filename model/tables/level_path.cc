// SPDX-License-Identifier: Apache-2.0
#include "model/tables/level_path.h"

#include <algorithm>
#include <cmath>

#include "model/numerics/lagrange.h"
#include "model/shared/shared.h"
#include "model/solver/sun_grid.h"

namespace skyfit {
namespace {

Shared<double> shared;  // stateless

LevelNode between_levels(const RayPoint& p, const std::vector<double>& heights, bool lowest) {
  const auto above = std::upper_bound(heights.begin() + 1, heights.end() - 1, p.height);
  const int level = static_cast<int>(above - heights.begin()) - 1;
  const double part = (p.height - heights[level]) / (heights[level + 1] - heights[level]);
  return {p.s, p.height, p.mu, level, part, lowest, {}, {}};
}

// Where the ray crosses the levels, ascending in s, with its two ends and its lowest point.
std::vector<LevelNode> crossings(const ViewRay& ray, double bottom,
                                 const std::vector<double>& heights, int level) {
  std::vector<LevelNode> nodes;
  auto cross = [&](double s, int at) {
    nodes.push_back({s, heights[at], ray_point(ray, bottom, s).mu, at, 0, false, {}, {}});
  };
  cross(0, level);
  const int last = static_cast<int>(heights.size()) - 1;
  int up = level + 1;
  if (ray.tangent_s > 0) {
    for (up = level; up > 0 && heights[up - 1] > ray.tangent_height; --up) {
      cross(
          shared.distance_to_inner_sphere(bottom, ray.entry_height, ray.entry_mu, heights[up - 1]),
          up - 1);
    }
  }
  if (ray.hits_ground) {
    cross(ray.length, 0);
    return nodes;
  }
  if (ray.tangent_s > 0)
    nodes.push_back(between_levels(ray_point(ray, bottom, ray.tangent_s), heights, true));
  for (; up <= last; ++up) {
    const double s = up == last ? ray.length
                                : shared.distance_to_outer_sphere(bottom, ray.entry_height,
                                                                  ray.entry_mu, heights[up]);
    if (s > nodes.back().s) cross(s, up);
  }
  if (nodes.size() < 2) cross(ray.length, last);
  return nodes;
}

// Along the limb two levels may lie so far apart that the edge of the planet's shadow falls between
// them: no step lets the sun's height change by more than 0.6 degrees.
std::vector<LevelNode> with_short_steps(const std::vector<LevelNode>& coarse, const ViewRay& ray,
                                        double bottom, const std::vector<double>& heights) {
  const double longest = 0.01 * bottom;
  constexpr double kMostSteps = 32;
  std::vector<LevelNode> nodes;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    nodes.push_back(coarse[i]);
    if (i + 1 == coarse.size()) break;
    const double length = coarse[i + 1].s - coarse[i].s;
    const int steps = static_cast<int>(std::min(std::ceil(length / longest), kMostSteps));
    for (int k = 1; k < steps; ++k) {
      const RayPoint p = ray_point(ray, bottom, coarse[i].s + length * k / steps);
      nodes.push_back(between_levels(p, heights, false));
    }
  }
  return nodes;
}

// Nodes that share the cubic's work: all nodes, or those with a source.
class Interpolation {
 public:
  template <class Keep>
  Interpolation(const std::vector<LevelNode>& nodes, bool layers, Keep keep) : layers_(layers) {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (keep(nodes[i])) index_.push_back(i);
    }
    drop_near_lowest(nodes);
    for (const std::size_t i : index_) s_.push_back(nodes[i].s);
    count_ = std::min(4, static_cast<int>(s_.size()));
  }

  // Calls add(node, share) for the nodes about s.
  template <class Add>
  void share(double s, Add add) const {
    const int above = static_cast<int>(std::upper_bound(s_.begin(), s_.end(), s) - s_.begin());
    const int last = static_cast<int>(s_.size()) - 1;
    NodeRange range{std::clamp(above - 2, 0, last + 1 - count_), count_};
    if (layers_) range = without_short_steps(s_, std::clamp(above, 1, last), range);
    const auto [first, count] = range;
    double shares[4];
    lagrange_weights(&s_[first], count, s, shares);
    for (int n = 0; n < count; ++n) add(index_[first + n], shares[n]);
  }

 private:
  // Crossings close to the ray's lowest point say nothing new and spoil the interpolation; so does
  // that point close to the ray's beginning.
  void drop_near_lowest(const std::vector<LevelNode>& nodes) {
    const auto s = [&](std::size_t i) { return nodes[index_[i]].s; };
    const auto drop = [&](std::size_t i) {
      index_.erase(index_.begin() + static_cast<std::ptrdiff_t>(i));
    };
    for (std::size_t i = 1; i + 1 < index_.size(); ++i) {
      if (!nodes[index_[i]].lowest) continue;
      if (i + 2 < index_.size() && s(i + 1) - s(i) < kLeastShare * (s(i + 2) - s(i + 1)))
        drop(i + 1);
      if (i > 1 && s(i) - s(i - 1) < kLeastShare * (s(i - 1) - s(i - 2))) {
        drop(i - 1);
      } else if (i == 1 && s(1) - s(0) < kLeastShare * (s(2) - s(1))) {
        drop(1);
      }
      return;
    }
  }

  static constexpr double kLeastShare = 0.25;  // of the distance to the next

  bool layers_;
  std::vector<std::size_t> index_;
  std::vector<double> s_;
  int count_;
};

// Gauss's rule of three nodes, and the integrals up to them of the parabola through them.
constexpr int kOrder = 3;
const double kRoot15 = std::sqrt(15.0);
const std::array<double, kOrder> kNode = {0.5 - kRoot15 / 10, 0.5, 0.5 + kRoot15 / 10},
                                 kWeight = {5.0 / 18, 4.0 / 9, 5.0 / 18};
const std::array<std::array<double, kOrder>, kOrder> kUpTo = {
    {{5.0 / 36, 2.0 / 9 - kRoot15 / 15, 5.0 / 36 - kRoot15 / 30},
     {5.0 / 36 + kRoot15 / 24, 2.0 / 9, 5.0 / 36 - kRoot15 / 24},
     {5.0 / 36 + kRoot15 / 30, 2.0 / 9 + kRoot15 / 15, 5.0 / 36}}};

void add(double share, const LevelWeights& from, LevelWeights& to) {
  for (std::size_t s = 0; s < from.size(); ++s) {
    for (std::size_t k = 0; k < 4; ++k) to[s][k] += share * from[s][k];
  }
}

// Where the ray crosses the ends of layers, ascending in s.
std::vector<double> layer_edges(const Shells& shells, const ViewRay& ray) {
  std::vector<double> heights;
  for (const Profile& profile : shells.profiles) {
    if (!profile.is_layer()) continue;
    const std::vector<double>& corners = profile.table().heights();
    heights.insert(heights.end(), corners.begin(), corners.end());
  }
  if (heights.empty()) return {};
  std::ranges::sort(heights);
  return shell_crossings(ray, shells.bottom_radius, heights);
}

// Calls part(begin, end) for the parts between the edges (ascending).
template <class Part>
void for_parts(double begin, double end, const std::vector<double>& edges, const Part& part) {
  for (const double edge : edges) {
    if (!(edge > begin && edge < end)) continue;
    part(begin, edge);
    begin = edge;
  }
  part(begin, end);
}

}  // namespace

// docs/theory (9.11).
std::vector<LevelNode> level_path(const Shells& shells, const NodeOptics& optics,
                                  const std::vector<double>& heights, const ViewRay& ray,
                                  int level) {
  std::vector<LevelNode> nodes = with_short_steps(
      crossings(ray, shells.bottom_radius, heights, level), ray, shells.bottom_radius, heights);
  const std::vector<double> edges = layer_edges(shells, ray);
  const Interpolation of_beam(nodes, !edges.empty(), [](const LevelNode&) { return true; });
  const Interpolation of_source(nodes, !edges.empty(),
                                [](const LevelNode& n) { return n.has_source(); });
  const std::size_t profiles = shells.profiles.size(), scatterers = optics[0].scatterers.size();
  for (LevelNode& node : nodes) {
    node.beam.resize(scatterers);
    node.source.resize(scatterers);
  }
  NodeValues tau{};
  LevelWeights here(scatterers);
  const auto add_piece = [&](double begin, double end) {
    const double length = end - begin;
    std::array<std::array<double, kMostConstituents>, kOrder> density;
    std::array<NodeValues, kOrder> extinction{};
    for (int j = 0; j < kOrder; ++j) {
      const double h = std::max(shared.height_after(shells.bottom_radius, ray.entry_height,
                                                    ray.entry_mu, begin + length * kNode[j]),
                                0.0);
      for (std::size_t p = 0; p < profiles; ++p) {
        density[j][p] = shells.profiles[p].density(h).value;
        for (std::size_t k = 0; k < 4; ++k)
          extinction[j][k] += length * optics[k].scaled_extinction[p].v * density[j][p];
      }
    }
    for (int j = 0; j < kOrder; ++j) {
      for (std::size_t k = 0; k < 4; ++k) {
        const double depth = tau[k] + kUpTo[j][0] * extinction[0][k] +
                             kUpTo[j][1] * extinction[1][k] + kUpTo[j][2] * extinction[2][k];
        const double reaches_eye = length * kWeight[j] * std::exp(-depth);
        for (std::size_t s = 0; s < scatterers; ++s)
          here[s][k] = reaches_eye * density[j][optics[k].scatterers[s].profile];
      }
      const double place = begin + length * kNode[j];
      of_beam.share(place, [&](std::size_t n, double share) { add(share, here, nodes[n].beam); });
      of_source.share(place,
                      [&](std::size_t n, double share) { add(share, here, nodes[n].source); });
    }
    for (std::size_t k = 0; k < 4; ++k) {
      for (int j = 0; j < kOrder; ++j) tau[k] += kWeight[j] * extinction[j][k];
    }
  };
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    for_parts(nodes[i].s, nodes[i + 1].s, edges,
              [&](double begin, double end) { for_pieces(begin, end, add_piece); });
  }
  return nodes;
}

}  // namespace skyfit
