// SPDX-License-Identifier: Apache-2.0
// A spectral scan of the sky, one direction a line. Columns: sample (a number of its own for every
// direction), view_azimuth_deg, view_zenith_deg, and radiance_NM for every wavelength in nm; one
// luminance_cd_m2 beside them is not used. Comment lines before them state the facts of
// scan_header.h and the unit, as `radiance_<nm> in UNIT`. Azimuths are clockwise from north unless
// the facts say otherwise.
#pragma once

#include <string_view>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

// Whether a line of column names is that of a spectral scan.
bool is_spectral_scan(std::string_view columns);

// Throws std::invalid_argument `source:line: column = value: expected ...`.
Reference parse_spectral_scan(std::string_view text, std::string_view source,
                              const ImportOptions& options);

}  // namespace skyfit::refs
