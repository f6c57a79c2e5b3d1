// SPDX-License-Identifier: Apache-2.0
#include "model/solver/particle_matrices.h"

#include <algorithm>
#include <cmath>

namespace skyfit {
namespace {

// sum += factor x, the factor by lane.
void add_scaled(const double* factor, const Parities& x, Parities& sum) {
  for (std::size_t parity = 0; parity < 2; ++parity) {
    sum[parity].resize(x[parity].size(), 0.0);
    batch::add_scaled(factor, x[parity].data(), sum[parity].data(),
                      x[parity].size() / batch::kBatchWidth);
  }
}

// sum += by_l x, a number per row of x.
void add_rows(const Parities& by_l, const Parities& x, std::size_t columns, Parities& sum) {
  Batch product;
  for (std::size_t parity = 0; parity < 2; ++parity) {
    sum[parity].resize(x[parity].size(), 0.0);
    if (by_l[parity].empty()) continue;
    product.resize(x[parity].size());
    batch::scale_rows(by_l[parity].data(), x[parity].data(), product.data(),
                      by_l[parity].size() / batch::kBatchWidth, columns);
    for (std::size_t k = 0; k < product.size(); ++k) sum[parity][k] += product[k];
  }
}

// By column and lane: the largest number, or difference from `before` where there is one.
std::vector<double> largest(const LevelMoments& moments, std::size_t columns,
                            const LevelMoments& before = {}) {
  const std::size_t width = columns * batch::kBatchWidth;
  std::vector<double> result(width, 0.0);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    for (std::size_t parity = 0; parity < 2; ++parity) {
      const Batch& x = moments[i][parity];
      for (std::size_t k = 0; k < x.size(); ++k) {
        const double from = before.empty() ? 0 : before[i][parity][k];
        result[k % width] = std::max(result[k % width], std::abs(x[k] - from));
      }
    }
  }
  return result;
}

}  // namespace

// docs/theory (13.18).
ParticleMatrices::ParticleMatrices(const Streams& streams, const LayerMedium& intensity,
                                   const LayerMedium& polarised, const LaneModes& modes)
    : basis_(streams, modes, polarised.moments) {
  const auto by_mode = [&](const LayerMedium::Matrix& matrix) {
    if (matrix.alpha.empty()) return Moments{};
    return Moments{basis_.by_mode(matrix.alpha), basis_.by_mode(matrix.zeta),
                   basis_.by_mode(matrix.gamma)};
  };
  for (const LayerMedium::Scatterer& s : polarised.scatterers)
    scatterers_.push_back(by_mode(s.matrix));
  for (const LayerMedium::PhaseTangent& t : polarised.phase_tangents)
    tangents_.push_back(by_mode(t.matrix));
  const auto levels = static_cast<std::size_t>(streams.levels());
  of_level_.resize(levels);
  intensity_gamma_.resize(levels);
  for (std::size_t i = 0; i < levels; ++i) {
    for (std::size_t s = 0; s < scatterers_.size(); ++s) {
      if (polarised.scatterers[s].matrix.alpha.empty()) continue;
      const double* const share = polarised.scatterers[s].share[i].data();
      add_scaled(share, scatterers_[s].alpha, of_level_[i].alpha);
      add_scaled(share, scatterers_[s].zeta, of_level_[i].zeta);
      add_scaled(share, scatterers_[s].gamma, of_level_[i].gamma);
      add_scaled(intensity.scatterers[s].share[i].data(), scatterers_[s].gamma,
                 intensity_gamma_[i]);
    }
  }
}

// docs/theory (13.19).
template <class MatrixOf>
std::array<StreamColumns, 2> ParticleMatrices::light_of(const MatrixOf& matrix_of,
                                                        const LevelMoments& intensity,
                                                        const SpinMoments& spin,
                                                        std::size_t columns) const {
  LevelMoments kept(intensity.size()), turned(intensity.size());
  for (std::size_t i = 0; i < intensity.size(); ++i) {
    const Moments& matrix = matrix_of(i);
    for (std::size_t parity = 0; parity < 2; ++parity)
      turned[i][parity].assign(intensity[i][parity].size(), 0.0);
    add_rows(matrix.gamma, intensity[i], columns, kept[i]);
    if (spin.b.empty()) continue;
    add_rows(matrix.alpha, spin.b[i], columns, kept[i]);
    add_rows(matrix.zeta, spin.c[i], columns, turned[i]);
  }
  return basis_.at_rays(kept, turned, columns);
}

std::array<StreamColumns, 2> ParticleMatrices::scattered(const LevelMoments& intensity,
                                                         const SpinMoments& spin,
                                                         std::size_t columns) const {
  return light_of([&](std::size_t i) -> const Moments& { return of_level_[i]; }, intensity, spin,
                  columns);
}

std::array<StreamColumns, 2> ParticleMatrices::scattered_by(const Moments& matrix,
                                                            const LevelMoments& intensity,
                                                            const SpinMoments& spin,
                                                            std::size_t columns) const {
  return light_of([&](std::size_t) -> const Moments& { return matrix; }, intensity, spin, columns);
}

LevelMoments ParticleMatrices::intensity_moments(const SpinMoments& spin,
                                                 std::size_t columns) const {
  LevelMoments r(intensity_gamma_.size());
  for (std::size_t i = 0; i < r.size(); ++i)
    add_rows(intensity_gamma_[i], spin.b[i], columns, r[i]);
  return r;
}

// The change from `before`, as a share of I in each column.
double ParticleMatrices::change(const SpinMoments& now, const SpinMoments& before,
                                const LevelMoments& intensity, std::size_t columns) {
  const std::vector<double> all = largest(intensity, columns);
  double result = 0;
  for (auto moments : {&SpinMoments::b, &SpinMoments::c}) {
    const std::vector<double> difference = largest(now.*moments, columns, before.*moments);
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (difference[k] > result * all[k]) result = all[k] > 0 ? difference[k] / all[k] : 1;
    }
  }
  return result;
}

}  // namespace skyfit
