// SPDX-License-Identifier: Apache-2.0
#include "model/literature/slab_kernels.h"

#include <cstddef>
#include <stdexcept>

#include "model/numerics/clones.h"

namespace skyfit::literature {
namespace {

// Inlined into the clones, to be compiled for each of them.
template <int kWidth>
[[gnu::always_inline]] inline void add(const SlabNode& node, double* __restrict slab,
                                       double* __restrict out) {
  constexpr std::size_t kTexels = SlabShape::texels, kAngles = SlabShape::angles;
  const double *a = node.corner[0], *b = node.corner[1], *c = node.corner[2], *d = node.corner[3];
  const double wa = node.weight[0], wb = node.weight[1], wc = node.weight[2], wd = node.weight[3];
  for (std::size_t i = 0; i < kTexels * kWidth; ++i)
    slab[i] = wa * a[i] + wb * b[i] + wc * c[i] + wd * d[i];
  double through[kWidth];
  for (int p = 0; p < kWidth; ++p) through[p] = node.through[p];
  for (std::size_t k = 0; k < kTexels; ++k) {
    const unsigned position = node.sun[k];
    const double part = (position % SlabShape::parts) * (1.0 / SlabShape::parts);
    const double* near = slab + (position / SlabShape::parts * kAngles + k % kAngles) * kWidth;
    const double* far = near + kAngles * kWidth;
    double* sum = out + k * kWidth;
    const double value = near[0] + part * (far[0] - near[0]);
    for (int p = 0; p < kWidth; ++p) {
      const double source = near[p] + part * (far[p] - near[p]);
      sum[p] += through[0] * source + (p > 0 ? through[p] * value : 0.0);
    }
  }
}

SKYFIT_CLONES void add_values(const SlabNode& node, double* slab, double* out) {
  add<1>(node, slab, out);
}
SKYFIT_CLONES void add_seven(const SlabNode& node, double* slab, double* out) {
  add<8>(node, slab, out);
}

}  // namespace

void add_node(int derivatives, const SlabNode& node, double* slab, double* out) {
  switch (derivatives) {
    case 0:
      return add_values(node, slab, out);
    case 7:
      return add_seven(node, slab, out);
    default:
      throw std::logic_error("add_node: derivatives must be 0 or 7");
  }
}

}  // namespace skyfit::literature
