// SPDX-License-Identifier: Apache-2.0
// The files .dat of the sky radiometers PREDE POM-01 and POM-02, those of SKYNET. Two header lines,
//   POM-01,tracker,sensor,longitude,latitude,date and time UTC,date and time local
//   number of channels,wavelengths in nm
// then scans, each of a line and one line a direction, by ascending angle from the sun:
//   03/05/28,20:20:02,03/05/29,05:20:02,H,site     UTC, local; H horizontal, V vertical
//   20:20:02,05:20:02,-108.59,009.45,9.7580E-10,.. UTC, local, azimuth from south, westward > 0,
//                                                  height, degrees; a current in A per channel; a
//                                                  POM-02 adds temperatures and pressure
// The first direction of a scan is the sun. As in SKYRAD.pack (dtform), directions count from it,
// for the instrument's axes are a degree or two off; more than 5 deg off is refused. The sun stands
// where it is when the scan begins: in the minutes of one scan it moves by half a degree or so.
//
// A current U becomes a radiance by the instrument's calibration (pom_instrument.h):
//   L = U E0 / (F0 SVA),  E0 the solar irradiance at 1 au (ASTM E490, 5 nm) at the channel's centre
// Layout: the vendor's manual of the POM-02 (data format), and the reader and files of skyrad.pack
// 5.0. Its older types (POM-01L, POM-01MKII) and its own files .DT3 to .DT5 are not read.
#pragma once

#include <string_view>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

bool is_sky_radiometer(std::string_view first_line);

// ImportOptions::instrument_parameters is needed. Throws std::invalid_argument
// `source:line: field = value: expected ...`, std::runtime_error when that file cannot be read.
Reference parse_sky_radiometer(std::string_view text, std::string_view source,
                               const ImportOptions& options);

}  // namespace skyfit::refs
