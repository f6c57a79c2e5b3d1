// SPDX-License-Identifier: Apache-2.0
// What may be unknown of an instrument: where it points and how it is calibrated.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "model/atmosphere/parameters.h"
#include "model/geometry/sky_point.h"

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
using InstrumentState = std::array<double, kInstrumentCount>;  // radians, 1

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

enum class Pointing {
  kStated,         // the instrument points where it says
  kAzimuth,        // an unknown azimuth offset per scan
  kAzimuthAndTilt  // and two unknown tilts per scan
};
std::string_view pointing_name(Pointing pointing);  // "stated", "azimuth", "tilt"

// Where the instrument truly points. `sun_azimuth`: radians from north.
SkyPoint pointed(const SkyPoint& stated, double sun_azimuth, const InstrumentState& instrument);

}  // namespace skyfit::fit
