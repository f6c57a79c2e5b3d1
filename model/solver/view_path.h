// SPDX-License-Identifier: Apache-2.0
// One view ray prepared for any number of suns: its nodes at the solver's levels and the weights
// with which the source of multiple scattering at the nodes adds up to radiance.
#pragma once

#include <vector>

#include "model/atmosphere/optics.h"

namespace skyfit {

struct ViewPath {
  ViewRay ray;
  std::vector<RayPoint> nodes;  // ascending in s; empty when the ray misses the atmosphere
  // Where the sun of each node's source is taken: the node itself, but not higher than 0.45 of the
  // atmosphere above the ray's lowest point. What is left there (0.4 % of the Earth's air) is too
  // little to ask for suns of its own.
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

// docs/theory (13.16).
// What light loses between where it was scattered last and the eye, per profile: as it counts for
// I, delta-M-scaled; for Q and U less what particles of a size distribution scatter forward with
// its polarisation.
template <int N>
std::vector<Dual<N>> extinction_to_eye(const Optics<N>& optics, bool polarised) {
  std::vector<Dual<N>> extinction = optics.scaled_extinction;
  if (!polarised) return extinction;
  for (const Scatterer<N>& s : optics.scatterers) {
    if (s.phase.type != PhaseType::kSizeDistribution) continue;
    const Dual<N> cut = s.scattering - s.scaled_scattering;
    extinction[s.profile] -=
        s.scattering * with_slopes(s.phase.optics->kept_polarisation, s.phase.particles) - cut;
  }
  return extinction;
}

// Per scatterer and node, sr^0: radiance = sum of weight times source per scattering coefficient.
template <int N>
using NodeWeights = std::vector<std::vector<Dual<N>>>;
template <int N>
NodeWeights<N> node_weights(const Optics<N>& optics, const ViewPath& path, bool polarised);

}  // namespace skyfit
