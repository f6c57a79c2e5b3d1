// SPDX-License-Identifier: Apache-2.0
// The scatterers of an atmosphere by their phase functions: light that was scattered once keeps the
// phase function of its scatterer until it is looked up, so tables hold it apart for each of them.
#pragma once

#include <vector>

#include "model/atmosphere/atmosphere.h"

namespace skyfit {

struct PhaseClasses {
  static constexpr int kRayleighLike = 0;

  double depolarisation = 0;  // of class 0, Rayleigh's phase function
  // Of class 1, 2, ..; at least one, so that a shader always has one.
  std::vector<PhaseFunction<double>> others;
  std::vector<int> of_constituent;  // 0 for one that does not scatter

  std::size_t count() const { return 1 + others.size(); }
};

PhaseClasses phase_classes(const Atmosphere<double>& atmosphere);

}  // namespace skyfit
