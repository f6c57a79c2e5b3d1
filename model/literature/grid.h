// SPDX-License-Identifier: Apache-2.0
// Tables of dual numbers on regular grids of coordinates 0..1, read by linear interpolation between
// texel centres, as a texture is.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "model/numerics/dual.h"

namespace skyfit::literature {

// A coordinate in 0..1 between two of `size` texels: (1 - part) of `low` and `part` of low + 1.
struct Between {
  int low = 0;
  double part = 0;
};
inline Between between(double unit, int size) {
  const double x = std::clamp(unit, 0.0, 1.0) * (size - 1);
  const int low = std::min(static_cast<int>(x), size - 2);
  return {low, x - low};
}
inline double unit_of(int texel, int size) { return texel / (size - 1.0); }

// sum += a b, and sum += a b with a constant a.
template <int N>
void add_product(const Dual<N>& a, const Dual<N>& b, Dual<N>& sum) {
  sum.v += a.v * b.v;
  for (std::size_t p = 0; p < N; ++p) sum.d[p] += a.v * b.d[p] + a.d[p] * b.v;
}
template <int N>
void add_scaled(double a, const Dual<N>& b, Dual<N>& sum) {
  sum.v += a * b.v;
  for (std::size_t p = 0; p < N; ++p) sum.d[p] += a * b.d[p];
}

// The last index varies fastest.
template <int N, int kRank>
class Grid {
 public:
  explicit Grid(const std::array<int, kRank>& size) : size_(size) {
    std::size_t count = 1;
    for (const int n : size) count *= static_cast<std::size_t>(n);
    texels_.resize(count);
  }
  std::array<Between, kRank> between_texels(const std::array<double, kRank>& unit) const {
    std::array<Between, kRank> place;
    for (std::size_t axis = 0; axis < kRank; ++axis) place[axis] = between(unit[axis], size_[axis]);
    return place;
  }
  std::size_t count() const { return texels_.size(); }
  std::size_t bytes() const { return texels_.size() * sizeof(Dual<N>); }
  std::size_t index(const std::array<int, kRank>& at) const {
    std::size_t i = 0;
    for (std::size_t axis = 0; axis < kRank; ++axis)
      i = i * static_cast<std::size_t>(size_[axis]) + static_cast<std::size_t>(at[axis]);
    return i;
  }
  Dual<N>& operator[](std::size_t i) { return texels_[i]; }
  const Dual<N>& operator[](std::size_t i) const { return texels_[i]; }
  Dual<N>& at(const std::array<int, kRank>& i) { return texels_[index(i)]; }
  const Dual<N>& at(const std::array<int, kRank>& i) const { return texels_[index(i)]; }

  Dual<N> linear(const std::array<Between, kRank>& place) const {
    Dual<N> sum(0.0);
    std::array<int, kRank> at;
    for (unsigned corner = 0; corner < 1u << kRank; ++corner) {
      double weight = 1;
      for (std::size_t axis = 0; axis < kRank; ++axis) {
        const bool high = (corner >> axis & 1u) != 0;
        weight *= high ? place[axis].part : 1 - place[axis].part;
        at[axis] = place[axis].low + high;
      }
      if (weight != 0) add_scaled(weight, texels_[index(at)], sum);
    }
    return sum;
  }

 private:
  std::array<int, kRank> size_;
  std::vector<Dual<N>> texels_;
};

}  // namespace skyfit::literature
