// SPDX-License-Identifier: Apache-2.0
// What a joint fit of several scans varies: parameters of the atmosphere, shared or one per scan,
// and what is not known of the instrument: where it points and how it is calibrated.
#pragma once

#include <array>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "fit/problem/free_parameters.h"
#include "fit/problem/scan_data.h"

namespace skyfit::fit {

// Angles in radians. The true direction is the stated one, turned clockwise by the azimuth offset
// about the zenith, then leant by the tilts with the instrument's axis.
enum class Instrument {
  kAzimuthOffset,  // true minus stated azimuth, clockwise seen from above
  kTiltNorth,      // lean of the axis toward north; toward the sun where north is not known
  kTiltEast,
  kScale,  // measured over true value
};
inline constexpr int kInstrumentCount = 4;

struct InstrumentInfo {
  Instrument id;
  std::string_view name;  // "instrument.azimuth_offset"
  std::string_view unit;  // "deg" or "1"
  double unit_value;      // one unit of the report in radians, or 1
  double start, lower, upper;
  std::optional<Prior> prior;
  std::string_view meaning;
};
std::span<const InstrumentInfo, kInstrumentCount> instrument_table();
const InstrumentInfo& instrument_info(Instrument id);
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
  std::vector<std::array<double, kInstrumentCount>> instrument;
  bool one_atmosphere = true;  // all are equal
};

// Before the fit: the same everywhere.
SkyState start_state(const Atmosphere<double>& atmosphere, int scans);

double get_unknown(const SkyState& state, const Unknown& unknown);
SkyState with_unknowns(SkyState state, const std::vector<Unknown>& unknowns,
                       const Eigen::VectorXd& scaled);
Eigen::VectorXd scaled_values(const std::vector<Unknown>& unknowns, const SkyState& state);

// Where the instrument truly points. `sun_azimuth`: radians from north.
SkyPoint pointed(const SkyPoint& stated, double sun_azimuth,
                 const std::array<double, kInstrumentCount>& instrument);

}  // namespace skyfit::fit
