// SPDX-License-Identifier: Apache-2.0
// A view ray that begins on one of a list of levels, as a quadrature whose nodes lie on levels:
// what is known at the levels (a transmittance, a source of light) adds up along the ray without
// interpolation in height. The sun's beam, which changes fast along low rays, is taken at every
// level, and between two levels where they are far apart; the source of multiple scattering at some
// levels; both at the ray's lowest point. Four wavelengths at once; lengths in metres.
#pragma once

#include <array>
#include <vector>

#include "model/geometry/ray.h"
#include "model/tables/diffuse_source.h"

namespace skyfit {

// Integrals of density times transmittance to the eye, with a node's share in the cubic through its
// neighbours (m), for each scatterer.
using LevelWeights = std::vector<NodeValues>;

// The source is taken at every third level.
inline constexpr int kSourceStep = 3;

struct LevelNode {
  double s, height, mu;
  int level;
  double part;  // of the way from the level to the one above
  bool lowest;  // of the ray, between two levels
  LevelWeights beam, source;

  bool on_level() const { return part == 0; }
  bool has_source() const { return lowest || (on_level() && level % kSourceStep == 0); }
};

// `heights` ascend from 0 to the top, which has a source; the ray begins at `level`, which has one
// too, or within a hair of it. The extinction is the delta-M-scaled one.
std::vector<LevelNode> level_path(const Shells& shells, const NodeOptics& optics,
                                  const std::vector<double>& heights, const ViewRay& ray,
                                  int level);

}  // namespace skyfit
