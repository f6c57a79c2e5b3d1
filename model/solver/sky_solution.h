// SPDX-License-Identifier: Apache-2.0
// The reference model's work for one atmosphere: the diffuse fields, once per wavelength, for the
// suns that are needed; then any number of view rays and suns. What radiance() and irradiance()
// stand on.
#pragma once

#include <span>
#include <vector>

#include "model/solver/multiple_scattering.h"
#include "model/solver/reference_model.h"

namespace skyfit {

// Cosines of local sun zenith angles.
struct SunRange {
  double lowest, highest;
};

template <int N>
class SkySolution {
 public:
  // Solves the diffuse field for every sun of the grid that the ranges touch. `optics` stay where
  // they are.
  SkySolution(const Shells& shells, const LevelGrid& levels, const std::vector<Optics<N>>& optics,
              std::size_t derivatives, std::span<const SunRange> needed,
              const ReferenceOptions& options, FieldsOf kind);

  MultipleScattering<N> multiple_scattering() const {
    return {levels_, grid_, solved_, optics_, fields_};
  }
  // Light that comes straight from the ground at the end of the path (1/sr), under the sun's beam
  // and under the diffuse field.
  Dual<N> ground(const ViewPath& path, const SunAlongRay& sun, int wavelength, bool beam,
                 bool diffuse) const;

 private:
  Shells shells_;
  LevelGrid levels_;
  SunGrid grid_;
  std::vector<int> solved_;  // grid index -> solved index, -1 when not needed
  const std::vector<Optics<N>>& optics_;
  std::vector<DiffuseField> fields_;
};

}  // namespace skyfit
