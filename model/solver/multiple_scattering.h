// SPDX-License-Identifier: Apache-2.0
// Light that was scattered or reflected before and is scattered once more toward the eye: the
// source that the diffuse field makes, integrated along view rays at the local sun.
#pragma once

#include <span>
#include <vector>

#include "model/geometry/sun_along_ray.h"
#include "model/solver/diffuse_field.h"
#include "model/solver/level_grid.h"
#include "model/solver/sun_grid.h"
#include "model/solver/view_path.h"

namespace skyfit {

// A point of the sky on a view ray: where its sun stands, and where its result goes.
struct SunOfPath {
  const SunAlongRay* sun;
  double* out;  // [wavelength][slice], added to; 1/sr
};

struct PathWithSuns {
  const ViewPath* path;
  std::vector<SunOfPath> suns;
};

// A few paths at a time share the work at each level. `solved` maps nodes of the sun grid to the
// solved suns of the fields; one field and optics per wavelength.
template <int N>
class MultipleScattering {
 public:
  MultipleScattering(const LevelGrid& levels, const SunGrid& grid, const std::vector<int>& solved,
                     const std::vector<Optics<N>>& optics, const std::vector<DiffuseField>& fields)
      : levels_(levels), grid_(grid), solved_(solved), optics_(optics), fields_(fields) {}

  static constexpr int kPathsAtOnce = 6;  // rows of a block of kernels::multiply
  // Adds one Stokes parameter of the light, docs/theory (13.14).
  void add(std::span<const PathWithSuns> paths, Stokes which) const;

 private:
  struct Node;
  struct Group;
  struct Bundle;
  int stokes_modes() const {  // that Q and U have at most
    const FieldShape& shape = fields_.front().shape;
    return shape.matrices ? shape.moments : kPolarisedModes;
  }
  Bundle bundle_of(std::span<const PathWithSuns> paths, Stokes which) const;
  void add_mode(Bundle& bundle, std::span<const NodeWeights<N>> weights, int wave, int m) const;
  Dual<N> row_coefficient(const Node& node, const NodeWeights<N>& weights, const Optics<N>& optics,
                          const FieldShape& shape, Stokes which, int m, int row) const;
  const double* block_at(const Group& group, const DiffuseField& field, int m,
                         LargeArray& scratch) const;

  const LevelGrid& levels_;
  const SunGrid& grid_;
  const std::vector<int>& solved_;
  const std::vector<Optics<N>>& optics_;
  const std::vector<DiffuseField>& fields_;
};

}  // namespace skyfit
