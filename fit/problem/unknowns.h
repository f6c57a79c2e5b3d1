// SPDX-License-Identifier: Apache-2.0
// What a joint fit of several scans varies: parameters of the atmosphere, shared or one per scan,
// and what is not known of the instrument: where it points and how it is calibrated.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fit/problem/instrument.h"
#include "fit/problem/variable.h"

namespace skyfit::fit {

// Throws std::invalid_argument that lists the names of both tables.
std::variant<Parameter, Instrument> unknown_from_name(std::string_view name);

inline constexpr int kAllScans = -1;

struct Unknown : Variable {
  std::variant<Parameter, Instrument> what;
  int scan = kAllScans;

  std::string name() const;       // "mie.scattering", or "mie.scattering[2]" of the second scan
  std::string_view unit() const;  // of reports
  double unit_value() const;      // what the report's unit is in the variable's
  bool applies_to(int of_scan) const { return scan == kAllScans || scan == of_scan; }
};

// The atmosphere and the instrument of every scan.
struct SkyState {
  std::vector<Atmosphere<double>> atmosphere;
  std::vector<InstrumentState> instrument;
  bool one_atmosphere = true;  // all are equal
};

// Before the fit: the same everywhere.
SkyState start_state(const Atmosphere<double>& atmosphere, int scans);

double get_unknown(const SkyState& state, const Unknown& unknown);
SkyState with_unknowns(SkyState state, const std::vector<Unknown>& unknowns,
                       const Eigen::VectorXd& scaled);
Eigen::VectorXd scaled_values(const std::vector<Unknown>& unknowns, const SkyState& state);

}  // namespace skyfit::fit
