// SPDX-License-Identifier: Apache-2.0
// Functions of the scattering angle, 0 .. pi, by their values at fixed nodes: on each of some
// panels, short where forward peaks are, the polynomial through the Chebyshev-Lobatto nodes of the
// panel. Its Legendre moments are linear in those values. The nodes are symmetric about 90 deg.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace skyfit {

class AnglePanels {
 public:
  static constexpr int kNodes = 9;  // of a panel, shared at its ends

  AnglePanels();

  const std::vector<double>& cosines() const { return cosines_; }
  // Those from 0 to 90 deg, both included: the first ones.
  std::vector<double> forward_cosines() const {
    return {cosines_.begin(), cosines_.begin() + static_cast<std::ptrdiff_t>(size() / 2 + 1)};
  }
  std::size_t size() const { return cosines_.size(); }

  // The function at an angle (rad) is sum_k weight[k] value[first + k].
  struct Weights {
    std::size_t first;
    std::array<double, kNodes> weight;
  };
  Weights at(double angle) const;

  // 2 pi integral P_l(cos angle) f sin(angle) d angle is sum_i moment(l)[i] value[i], l <
  // kMostMoments.
  static constexpr int kMostMoments = 129;
  const double* moment(int l) const { return row(moments_, l); }
  // The same with Wigner's functions d^l_{2n} in the place of Legendre's.
  enum class Spin { kNone, kKept, kReversed };  // n = 0, 2, -2
  const double* moment(Spin spin, int l) const {
    return row(spin_moments_[static_cast<std::size_t>(spin)], l);
  }

 private:
  const double* row(const std::vector<double>& moments, int l) const {
    return moments.data() + static_cast<std::size_t>(l) * size();
  }

  std::vector<double> edges_, angles_, cosines_, moments_;
  std::array<std::vector<double>, 3> spin_moments_;
};

}  // namespace skyfit
