// SPDX-License-Identifier: Apache-2.0
// The matrices of a batch of modes: what lies below a level answers light with R, layer by layer.
#include <algorithm>
#include <numbers>

#include "model/solver/fourier_modes.h"

namespace skyfit {

// docs/theory (4.10).
// Matrices of the source that radiance makes: of rays that look the same way, and the other way.
void FourierModes::scattering(int level, Batch& same, Batch& other) const {
  const std::size_t n = rays(level);
  same.resize(n * n * kBatchWidth);
  other.resize(n * n * kBatchWidth);
  Batch weighted;
  Batch* const result[2] = {&same, &other};
  for (std::size_t parity = 0; parity < 2; ++parity) {
    weighted.resize(analysis_[level][parity].size());
    batch::scale_rows(omega_[level][parity].data(), analysis_[level][parity].data(),
                      weighted.data(), rows_[parity], n);
    batch::multiply(synthesis_[level][parity].data(), weighted.data(), nullptr,
                    result[parity]->data(), n, rows_[parity], n);
  }
  batch::butterfly(same.data(), other.data(), n * n);
}

// docs/theory (5.3): the ground.
void FourierModes::eliminate() {
  reflection_.resize(levels());
  forward_.resize(levels() - 1);
  backward_.resize(levels() - 1);
  const std::size_t n = rays(0);
  reflection_[0].assign(n * n * kBatchWidth, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const int ray = static_cast<int>(j);
      for (std::size_t k = 0; k < kBatchWidth; ++k)
        at(reflection_[0], n, i, j)[k] =
            2 * std::numbers::pi * albedo_[k] * streams_->weight(0, ray) * streams_->mu(0, ray);
    }
  }
  Batch same, other, same_above, other_above;
  scattering(0, same, other);
  for (int i = 0; i + 1 < levels(); ++i) {
    scattering(i + 1, same_above, other_above);
    eliminate_layer(i, same, other, same_above, other_above);
    same.swap(same_above);
    other.swap(other_above);
  }
}

// docs/theory (5.5) to (5.9).
// From R_i to R_{i+1}, and the matrices of both sweeps. A limb ray that begins at level i + 1 has
// U = D there.
void FourierModes::eliminate_layer(int layer, const Batch& same, const Batch& other,
                                   const Batch& same_above, const Batch& other_above) {
  const std::size_t n = rays(layer), above = rays(layer + 1);
  const LayerMedium::Layer& weights = medium_->layers[layer];
  const double *t = weights.t.data(), *near = weights.near.data(), *far = weights.far.data();
  const Batch& reflection = reflection_[layer];
  Batch down(n * n * kBatchWidth), up(n * n * kBatchWidth);  // sources per D once U = R D
  batch::multiply(other.data(), reflection.data(), same.data(), down.data(), n, n, n);
  batch::multiply(same.data(), reflection.data(), other.data(), up.data(), n, n, n);

  // D_i = G [(t + far A1) D' + far A2 U' + near S s + e], one elimination for all four.
  const std::size_t width = above + 3 * n;
  Batch matrix(n * n * kBatchWidth, 0.0), right(n * width * kBatchWidth, 0.0);
  add_diagonal(nullptr, matrix, n, 0, n);
  add_block(near, down, n, 0, matrix, n, 0, n, n, -1);
  add_diagonal(t, right, width, 0, n);
  add_block(far, same_above, above, 0, right, width, 0, n, above);
  add_block(far, other_above, above, n, right, width, n, n, above - n);
  add_block(far, other_above, above, 0, right, width, above, n, n);
  add_block(near, other, n, 0, right, width, above + n, n, n);
  add_diagonal(nullptr, right, width, above + 2 * n, n);
  batch::solve(matrix.data(), right.data(), n, width);
  const Batch from_down = columns_of(right, width, 0, n, above);
  const Batch from_up = columns_of(right, width, above, n, n);

  // U' = V [(near A3 + H G (t + far A1)) D' + P s + H G e + e'], with U_{i+1} per D_i in H.
  Batch h(n * n * kBatchWidth, 0.0), product(n * std::max(width, n) * kBatchWidth);
  add_block(t, reflection, n, 0, h, n, 0, n, n);
  add_block(far, up, n, 0, h, n, 0, n, n);
  batch::multiply(h.data(), right.data(), nullptr, product.data(), n, n, width);
  matrix.assign(n * n * kBatchWidth, 0.0);
  add_diagonal(nullptr, matrix, n, 0, n);
  add_block(near, same_above, above, 0, matrix, n, 0, n, n, -1);
  add_block(nullptr, product, width, above, matrix, n, 0, n, n, -1);
  Batch upward(n * width * kBatchWidth, 0.0);
  add_block(near, other_above, above, 0, upward, width, 0, n, above);
  add_block(near, same_above, above, n, upward, width, n, n, above - n);
  add_block(nullptr, product, width, 0, upward, width, 0, n, above);
  add_diagonal(t, upward, width, above, n);
  add_block(far, same, n, 0, upward, width, above, n, n);
  add_block(nullptr, product, width, above + n, upward, width, above, n, 2 * n);
  add_diagonal(nullptr, upward, width, above + 2 * n, n);
  batch::solve(matrix.data(), upward.data(), n, width);

  Batch& next = reflection_[layer + 1];
  next = columns_of(upward, width, 0, n, above);
  Batch& backward = backward_[layer];
  backward = right;
  batch::multiply(from_up.data(), next.data(), from_down.data(), product.data(), n, n, above);
  for (std::size_t i = 0; i < n; ++i)
    std::copy_n(at(product, above, i, 0), above * kBatchWidth, at(backward, width, i, 0));
  next.resize(above * above * kBatchWidth, 0.0);
  for (std::size_t i = n; i < above; ++i) {
    for (std::size_t k = 0; k < kBatchWidth; ++k) at(next, above, i, i)[k] = 1;
  }
  forward_[layer] = columns_of(upward, width, above, n, 3 * n);
}

}  // namespace skyfit
