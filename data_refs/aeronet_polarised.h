// SPDX-License-Identifier: Apache-2.0
// Polarised almucantars of AERONET, its product ALP (raw polarised almucantar sky scans) of version
// 3: a table as aeronet_table.h describes, with the columns, each by azimuth from the sun,
//   Degree_of_Polarization_for_Azimuth_Angle_in_Degree_25
//   P1_Radiance_for_Azimuth_Angle_in_Degrees[uW/cm^2/sr/nm]_25, and P2 and P3
// or the parts before the angles as titles in the line above. The layout is that of public code
// that reads such files (DataCrossing, which prepares them for GRASP); no file was at hand.
//
// P1, P2 and P3 are read through polarisers 60 deg apart (Cimel CE318-DP). So
//   degree = 2 sqrt(P1^2 + P2^2 + P3^2 - P1 P2 - P2 P3 - P3 P1) / (P1 + P2 + P3)
// must be the stated one within 0.05, or the direction is not used; this also tells a fraction
// from percent. The radiance is (P1 + P2 + P3) / 3, which is right when each was calibrated with
// light that is not polarised; the code does not say so, and a note does. Where the light is
// polarised is not stated: the degree alone becomes a reading of polarisation.
//
// Polarised principal planes and hybrid scans are refused: how they name directions is not known.
#pragma once

#include <string_view>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

bool is_aeronet_polarised(std::string_view text);

// Throws std::invalid_argument `source:line: column = value: expected ...` when no line is of use.
Reference parse_aeronet_polarised(std::string_view text, std::string_view source,
                                  const ImportOptions& options);

}  // namespace skyfit::refs
