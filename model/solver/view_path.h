// SPDX-License-Identifier: Apache-2.0
// One view ray prepared for any number of suns: its nodes at the solver's levels and the weights
// with which the source of multiple scattering at the nodes adds up to radiance.
#pragma once

#include <vector>

#include "model/atmosphere/optics.h"

namespace skyfit {

// Places along a ray, metres from its entry.
struct PartOfRay {
  double begin, end;
};
// Where the source of a ray is taken under the sun of each place: not higher than 0.45 of the
// atmosphere above the ray's lowest point. What is left there (0.4 % of the Earth's air) is too
// little to ask for suns of its own.
PartOfRay part_with_own_suns(const Shells& shells, const ViewRay& ray);

struct ViewPath {
  ViewRay ray;
  std::vector<RayPoint> nodes;  // ascending in s; empty when the ray misses the atmosphere
  // Where the sun of each node's source is taken: the node itself, or the end of that part.
  std::vector<RayPoint> sun_points;
  struct Sample {
    RayPoint point;
    double weight;        // of the quadrature along s, metres
    PathColumns columns;  // from the entry
    int first = 0;        // interpolation between the nodes first .. first + count - 1
    int count = 0;
    double share[4] = {};
  };
  std::vector<Sample> samples;  // of the smooth source of multiple scattering
  PathColumns columns_to_end;
};
ViewPath view_path(const Shells& shells, const std::vector<double>& heights, double altitude,
                   double mu);

// Per scatterer and node, sr^0: radiance = sum of weight times source per scattering coefficient.
template <int N>
using NodeWeights = std::vector<std::vector<Dual<N>>>;
template <int N>
NodeWeights<N> node_weights(const Optics<N>& optics, const ViewPath& path);

}  // namespace skyfit
