// SPDX-License-Identifier: Apache-2.0
// Which single change of clock or place puts the sun of a scan where it is known to be.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "data_refs/civil_time.h"
#include "data_refs/solar_position.h"

namespace skyfit::refs {

// A change, and the angle that it leaves between the two suns, radians.
struct Mend {
  std::string text;
  double apart;
};

// From a sun to where the sun is known to be, radians.
using AngleToSun = std::function<double(const SolarPosition&)>;

// The angle from a stated sun, radians: between zenith angles alone where its azimuth is not known.
AngleToSun angle_to_stated(double zenith, std::optional<double> azimuth);

// Of the sign of longitude and latitude, of both exchanged, of whole hours up to 12 and of the best
// minutes up to 40.
std::vector<Mend> mends_of_time_and_place(Instant time, const Site& site, const AngleToSun& angle);

// Of a sun below the horizon, by which of the usual mistakes it would stand above: the longitude's
// sign, or hours between the clock and UTC that are not the longitude's. "; longitude_deg = -76
// would put it at 41.2 deg", or empty.
std::string mends_above_horizon(Instant time, const Site& site, std::optional<double> utc_offset_h);

// "it would be mended by ..": the best of those that leave less than 0.4 of `apart`, at most three
// that are within `alike` of the best; or that no single change would.
std::string mended_by(std::vector<Mend> mends, double apart, double alike);

}  // namespace skyfit::refs
