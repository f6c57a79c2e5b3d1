// SPDX-License-Identifier: Apache-2.0
// A phase function from a table: its logarithm is linear in the scattering angle between the rows.
// It is normalised to integrate to 1 over the sphere.
#pragma once

#include "model/atmosphere/table_format.h"

namespace skyfit {

// Columns scattering_angle_deg, ascending from 0 to 180, and phase_per_sr, > 0, whose integral over
// the sphere is 1 within 5 %.
extern const TableFormat kPhaseFormat;

class TabulatedPhase {
 public:
  // Throws std::invalid_argument unless the table is as kPhaseFormat demands.
  explicit TabulatedPhase(TwoColumns table);

  const TwoColumns& table() const { return table_; }  // as given

  // 1/sr at a scattering angle in radians.
  double phase(double angle) const;

  // Legendre moments chi_0 = 1 .. chi_{count - 1}.
  std::vector<double> moments(int count) const;

 private:
  TwoColumns table_;
  std::vector<double> angle_, log_phase_;  // radians, normalised
};

}  // namespace skyfit
