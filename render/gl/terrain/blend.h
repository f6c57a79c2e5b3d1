// SPDX-License-Identifier: Apache-2.0
// Transitions between the materials of a ground.
#pragma once

#include <algorithm>
#include <cstddef>

#include "render/gl/terrain/ground.h"

namespace skyfit {

// 0 up to `low`, 1 from `high` on, smooth between, as GLSL's.
inline double smoothstep(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// a for t = 0, b for t = 1.
inline NodeValues mix(const NodeValues& a, const NodeValues& b, double t) {
  NodeValues r;
  for (std::size_t k = 0; k < 4; ++k) r[k] = a[k] + t * (b[k] - a[k]);
  return r;
}

}  // namespace skyfit
