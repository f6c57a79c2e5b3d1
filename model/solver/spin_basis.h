// SPDX-License-Identifier: Apache-2.0
// Q and U of the light along the streams as moments, for one batch of modes. With the functions of
// docs/theory (13.17), which take the place of Lambda_lm of I,
//   b_l = 2 pi integral (R_lm Q_m - T_lm U_m) dmu, c_l = 2 pi integral (R_lm U_m - T_lm Q_m) dmu;
// a scattering matrix turns these and the moments of I into sources of Q and U.
#pragma once

#include <array>
#include <vector>

#include "model/solver/stream_light.h"

namespace skyfit {

// Numbers per moment, (l x columns): of even and of odd l - m, in ascending order.
using Parities = std::array<Batch, 2>;
// At every level.
using LevelMoments = std::vector<Parities>;

struct SpinMoments {
  LevelMoments b, c;
};

// R_lm and T_lm for l = 0 .. count - 1 (0 where there are none), sr^-1/2, docs/theory (13.17).
void spin_functions(int m, int count, double mu, double* r, double* t);

class SpinBasis {
 public:
  // Of moments l < `moments`.
  SpinBasis(const Streams& streams, const LaneModes& modes, int moments);

  const std::array<std::size_t, 2>& rows() const { return rows_; }  // of Parities
  // From the numbers of every l, those of each lane's l - m.
  Parities by_mode(const Batch& of_l) const;

  SpinMoments analyse(const StreamColumns& q, const StreamColumns& u) const;
  // Q = R kept - T turned and U = R turned - T kept at the streams, summed over l.
  std::array<StreamColumns, 2> at_rays(const LevelMoments& kept, const LevelMoments& turned,
                                       std::size_t columns) const;

 private:
  static constexpr std::size_t kBatchWidth = batch::kBatchWidth;
  std::size_t rays(int level) const { return static_cast<std::size_t>(streams_->count(level)); }
  std::size_t own(std::size_t lane) const {
    return static_cast<std::size_t>(moments_ - modes_[lane]);
  }

  const Streams* streams_;
  LaneModes modes_;
  int moments_;
  std::array<std::size_t, 2> rows_;
  // Per level, by parity of l - m: (rays x l), and with the weights of the integral (l x rays). T
  // with the sign that it has in the formulas.
  LevelMoments r_, t_, weighted_r_, weighted_t_;
};

}  // namespace skyfit
