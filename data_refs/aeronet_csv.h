// SPDX-License-Identifier: Apache-2.0
// Almucantars of AERONET (sky radiances, version 3). After free header lines comes the line of the
// columns: Date(dd:mm:yyyy), Time(hh:mm:ss) in UTC, Nominal_Wavelength(nm),
// Solar_Zenith_Angle(Degrees), Sky_Scan_Type, where the file has them Exact_Wavelength(um),
// Latitude(Degrees), Longitude(Degrees) and Elevation(m), and a column for every azimuth from the
// sun: `-6.000000` or `Radiance_for_Azimuth_Angle_in_Degrees(uW/cm^2/sr/nm)_-6.000`, some of them
// twice. The view zenith angle is the sun's. -999 stands for a missing value. Every line is one
// wavelength with its own time; lines that follow each other within 15 min without repeating a
// wavelength are a scan.
#pragma once

#include <string_view>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

bool is_aeronet_csv(std::string_view text);

// Throws std::invalid_argument `source:line: column = value: expected ...`.
Reference parse_aeronet_csv(std::string_view text, std::string_view source,
                            const ImportOptions& options);

}  // namespace skyfit::refs
