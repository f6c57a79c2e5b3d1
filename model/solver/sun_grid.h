// SPDX-License-Identifier: Apache-2.0
// The fixed grid of local sun angles at which the diffuse field is solved, and cubic interpolation
// in it. The grid does not depend on what is asked, so neither does an answer.
#pragma once

#include <array>
#include <vector>

#include "model/atmosphere/shells.h"

namespace skyfit {

// Through the zenith the field goes on at the opposite azimuth, where odd modes change sign.
struct SunStencil {
  std::array<int, 4> index{};
  std::array<double, 4> even{}, odd{};  // weights for modes of even and of odd order
};

// A derivative by the zenith angle at one node of the grid, as a sum over nodes.
struct SunSlope {
  std::array<int, 5> index{};
  std::array<double, 5> even{}, odd{};  // 1/rad, for modes of even and of odd order
};

class SunGrid {
 public:
  explicit SunGrid(const Shells& shells);
  int size() const { return static_cast<int>(zenith_.size()); }
  double mu(int i) const;
  double zenith(int i) const { return zenith_[i]; }  // radians
  // Of the quartic through the node and its neighbours, of the field over the decay of twilight,
  // docs/theory (7.6).
  SunSlope slope(int i) const;
  // Lagrange's cubic in the zenith angle through the four nearest nodes, of the field over the
  // decay of twilight, which goes on below the grid.
  SunStencil stencil(double mu_s) const;

  double decay(double zenith) const;  // of the twilight, 1 by day

 private:
  void set_fours();
  double decay_rate(double zenith) const;  // 1/rad

  double fastest_, slow_;  // of the decay: its largest rate, 1/rad, and in what angle it gets there

  std::vector<double> zenith_;  // radians, ascending, from 0 to below the twilight
  int day_ = 0;                 // the node at 85 deg
  // Four neighbours, from the first or from one before it: Lagrange's weight i is factor[i] times
  // the distances to the other nodes.
  struct Four {
    std::array<int, 4> index;
    std::array<double, 4> node, factor;
  };
  std::vector<Four> fours_;
};

}  // namespace skyfit
