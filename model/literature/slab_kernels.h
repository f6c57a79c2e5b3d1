// SPDX-License-Identifier: Apache-2.0
// The inner loop of the tables of Bruneton & Neyret: light scattered at one node of a ray, for all
// suns and angles. Compiled for several instruction sets. A slab holds kSuns x kAngles dual numbers
// of N derivatives, as N + 1 doubles each.
#pragma once

#include <cstdint>

namespace skyfit::literature {

struct SlabShape {
  static constexpr int suns = 32, angles = 8, texels = suns * angles;
  // A place on the axis of the suns in units of 1/2048 texel, below suns - 1.
  static constexpr int parts = 2048;
};

// slab = sum_c weight[c] corner[c]; out[k] += through * slab at (sun[k], angle of k), linear
// between suns. `derivatives` N: 0 or 7.
struct SlabNode {
  const double* corner[4];
  double weight[4];
  const std::uint16_t* sun;  // [texels]
  const double* through;     // [N + 1]
};
void add_node(int derivatives, const SlabNode& node, double* slab, double* out);

}  // namespace skyfit::literature
