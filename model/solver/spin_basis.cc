// SPDX-License-Identifier: Apache-2.0
#include "model/solver/spin_basis.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/numerics/wigner.h"

namespace skyfit {

void spin_functions(int m, int count, double mu, double* r, double* t) {
  std::vector<double> kept(static_cast<std::size_t>(count)), reversed(kept);
  wigner_d2(m, count, mu, kept.data());
  wigner_d2(-m, count, mu, reversed.data());
  const double sign = m % 2 == 0 ? 1 : -1;
  for (int l = 0; l < count; ++l) {
    const double half = 0.5 * std::sqrt((2 * l + 1) / (4 * std::numbers::pi));
    r[l] = half * (kept[l] + sign * reversed[l]);
    t[l] = half * (kept[l] - sign * reversed[l]);
  }
}

SpinBasis::SpinBasis(const Streams& streams, const LaneModes& modes, int moments)
    : streams_(&streams), modes_(modes), moments_(moments) {
  const auto most = static_cast<std::size_t>(moments - std::ranges::min(modes));
  rows_ = {(most + 1) / 2, most / 2};
  std::vector<double> r(static_cast<std::size_t>(moments)), t(r);
  for (int i = 0; i < streams.levels(); ++i) {
    for (LevelMoments* all : {&r_, &t_, &weighted_r_, &weighted_t_}) {
      Parities& of_level = all->emplace_back();
      for (std::size_t parity = 0; parity < 2; ++parity)
        of_level[parity].assign(rays(i) * rows_[parity] * kBatchWidth, 0.0);
    }
    for (std::size_t k = 0; k < rays(i); ++k) {
      const int ray = static_cast<int>(k);
      const double weight = 2 * std::numbers::pi * streams.weight(i, ray);
      for (std::size_t lane = 0; lane < kBatchWidth; ++lane) {
        if (lane == 0 || modes_[lane] != modes_[lane - 1])
          spin_functions(modes_[lane], moments, streams.mu(i, ray), r.data(), t.data());
        for (std::size_t offset = 0; offset < own(lane); ++offset) {
          const std::size_t parity = offset % 2, row = offset / 2,
                            l = static_cast<std::size_t>(modes_[lane]) + offset;
          at(r_[i][parity], rows_[parity], k, row)[lane] = r[l];
          at(t_[i][parity], rows_[parity], k, row)[lane] = -t[l];
          at(weighted_r_[i][parity], rays(i), row, k)[lane] = weight * r[l];
          at(weighted_t_[i][parity], rays(i), row, k)[lane] = -weight * t[l];
        }
      }
    }
  }
}

Parities SpinBasis::by_mode(const Batch& of_l) const {
  Parities result;
  for (std::size_t parity = 0; parity < 2; ++parity)
    result[parity].assign(rows_[parity] * kBatchWidth, 0.0);
  for (std::size_t lane = 0; lane < kBatchWidth; ++lane) {
    for (std::size_t offset = 0; offset < own(lane); ++offset)
      at(result[offset % 2], 1, offset / 2, 0)[lane] =
          at(of_l, 1, static_cast<std::size_t>(modes_[lane]) + offset, 0)[lane];
  }
  return result;
}

// R_lm(-mu) = (-1)^(l-m) R_lm(mu) and T_lm(-mu) = -(-1)^(l-m) T_lm(mu): of even l - m, R takes the
// sum of what is seen looking up and down, T the difference; of odd l - m the other way round.
SpinMoments SpinBasis::analyse(const StreamColumns& q, const StreamColumns& u) const {
  const std::size_t columns = q.count;
  SpinMoments moments{LevelMoments(r_.size()), LevelMoments(r_.size())};
  Batch part;
  for (int i = 0; i < streams_->levels(); ++i) {
    std::array<Batch, 2> of_q = {q.down[i], q.up[i]}, of_u = {u.down[i], u.up[i]};
    batch::butterfly(of_q[0].data(), of_q[1].data(), rays(i) * columns);
    batch::butterfly(of_u[0].data(), of_u[1].data(), rays(i) * columns);
    for (std::size_t parity = 0; parity < 2; ++parity) {
      const std::size_t size = rows_[parity] * columns * kBatchWidth;
      part.resize(size);
      for (const auto& [out, by_r, by_t] :
           {std::tuple{&moments.b, &of_q, &of_u}, std::tuple{&moments.c, &of_u, &of_q}}) {
        Batch& sum = (*out)[i][parity];
        sum.resize(size);
        batch::multiply(weighted_r_[i][parity].data(), (*by_r)[parity].data(), nullptr, part.data(),
                        rows_[parity], rays(i), columns);
        batch::multiply(weighted_t_[i][parity].data(), (*by_t)[1 - parity].data(), part.data(),
                        sum.data(), rows_[parity], rays(i), columns);
      }
    }
  }
  return moments;
}

std::array<StreamColumns, 2> SpinBasis::at_rays(const LevelMoments& kept,
                                                const LevelMoments& turned,
                                                std::size_t columns) const {
  std::array<StreamColumns, 2> light;
  for (StreamColumns& c : light)
    c = {columns, std::vector<Batch>(r_.size()), std::vector<Batch>(r_.size())};
  Batch part;
  for (int i = 0; i < streams_->levels(); ++i) {
    part.resize(rays(i) * columns * kBatchWidth);
    for (std::size_t component = 0; component < 2; ++component) {
      const Parities& by_r = (component == 0 ? kept : turned)[i];
      const Parities& by_t = (component == 0 ? turned : kept)[i];
      const std::array<Batch*, 2> out = {&light[component].down[i], &light[component].up[i]};
      for (std::size_t parity = 0; parity < 2; ++parity) {
        out[parity]->resize(part.size());
        batch::multiply(r_[i][parity].data(), by_r[parity].data(), nullptr, part.data(), rays(i),
                        rows_[parity], columns);
        batch::multiply(t_[i][1 - parity].data(), by_t[1 - parity].data(), part.data(),
                        out[parity]->data(), rays(i), rows_[1 - parity], columns);
      }
      batch::butterfly(out[0]->data(), out[1]->data(), rays(i) * columns);
    }
  }
  return light;
}

}  // namespace skyfit
