// SPDX-License-Identifier: Apache-2.0
// What the scattering matrices of particles do to the modes of the diffuse field, for one batch:
// the sources of I, Q and U that they make of the moments of all three, docs/theory (13.19).
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "model/solver/spin_basis.h"

namespace skyfit {

class ParticleMatrices {
 public:
  // `intensity` is the medium of I, `polarised` that of Q and U, with matrices.
  ParticleMatrices(const Streams& streams, const LayerMedium& intensity,
                   const LayerMedium& polarised, const LaneModes& modes);

  const SpinBasis& basis() const { return basis_; }

  // docs/theory (13.18), by l - m; empty of a scatterer without a matrix.
  struct Moments {
    Parities alpha, zeta, gamma;
  };
  const std::vector<Moments>& scatterers() const { return scatterers_; }
  const std::vector<Moments>& tangents() const { return tangents_; }  // per phase tangent

  // The source functions of Q and U that all particles make of the moments of I and, where there
  // are any, of Q and U; the same of one matrix per unit of its scatterer's share.
  std::array<StreamColumns, 2> scattered(const LevelMoments& intensity, const SpinMoments& spin,
                                         std::size_t columns) const;
  std::array<StreamColumns, 2> scattered_by(const Moments& matrix, const LevelMoments& intensity,
                                            const SpinMoments& spin, std::size_t columns) const;
  // The moments of the source function of I that they make of Q and U.
  LevelMoments intensity_moments(const SpinMoments& spin, std::size_t columns) const;

  // How much the moments of Q and U differ from those `before`, or from 0, in the column where it
  // is most, as a share of the largest moment of I there.
  static double change(const SpinMoments& now, const SpinMoments& before,
                       const LevelMoments& intensity, std::size_t columns);

 private:
  template <class MatrixOf>  // the matrix of each level
  std::array<StreamColumns, 2> light_of(const MatrixOf& matrix_of, const LevelMoments& intensity,
                                        const SpinMoments& spin, std::size_t columns) const;

  SpinBasis basis_;
  std::vector<Moments> scatterers_, tangents_;
  // Sums over the scatterers by their shares, per level; gamma also by those of the medium of I.
  std::vector<Moments> of_level_;
  LevelMoments intensity_gamma_;
};

}  // namespace skyfit
