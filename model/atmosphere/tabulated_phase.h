// SPDX-License-Identifier: Apache-2.0
// A phase function from a table: its logarithm is linear in the scattering angle between the rows.
// It is normalised to integrate to 1 over the sphere.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <utility>

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
  // chi of kLastMoment, kept: how much of a forward peak the solver cuts off at most.
  static constexpr int kLastMoment = 32;
  double last_moment() const { return last_moment_; }

 private:
  TwoColumns table_;
  std::vector<double> angle_, log_phase_;  // radians, normalised
  double last_moment_ = 0;
};

// A phase function for each of some wavelengths; between them its logarithm is linear in the
// wavelength, beyond the first and the last it is theirs.
class SpectralPhase {
 public:
  // At least one; throws std::invalid_argument unless the wavelengths (nm) are > 0 and ascend and
  // there is one phase function for each.
  SpectralPhase(std::vector<double> wavelengths_nm,
                std::vector<std::shared_ptr<const TabulatedPhase>> phases);

  const std::vector<double>& wavelengths_nm() const { return wavelengths_nm_; }
  const std::vector<std::shared_ptr<const TabulatedPhase>>& phases() const { return phases_; }

  // Made when it is first asked for, then kept. Any number of threads.
  std::shared_ptr<const TabulatedPhase> at(double wavelength_nm) const;

 private:
  std::shared_ptr<const TabulatedPhase> between(std::size_t above, double wavelength_nm) const;

  std::vector<double> wavelengths_nm_;
  std::vector<std::shared_ptr<const TabulatedPhase>> phases_;
  mutable std::mutex mutex_;
  mutable std::map<double, std::shared_ptr<const TabulatedPhase>> made_;
};

}  // namespace skyfit
