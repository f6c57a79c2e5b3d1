// SPDX-License-Identifier: Apache-2.0
// A CSV of luminance samples becomes a Reference. Columns, in any order (data_refs/examples/ has a
// file that shows them):
//   sun_zenith_deg       0 <= . < 90: the sun stands above the horizon
//   view_zenith_deg      0 <= . < 90
//   relative_azimuth_deg -360 .. 360, 0 = toward the sun; or sun_azimuth_deg and view_azimuth_deg,
//   in one sense of turning luminance_cd_m2      > 0; or relative_luminance > 0, free up to a
//   factor per scan sigma                optional, > 0: one standard deviation in the unit of the
//   luminance weight               optional, >= 0, 1 when absent; 0 leaves the sample out scan
//   optional label; samples of one scan share a luminance scale. When absent, every sun position is
//                        a scan.
// Format of the text: data_refs/csv.h.
#pragma once

#include <filesystem>
#include <string_view>

#include "data_refs/samples.h"

namespace skyfit::refs {

// Throws std::invalid_argument with one line that names source, line, column, value and what was
// expected.
Reference parse_sample_csv(std::string_view text, std::string_view source);

// Throws std::runtime_error when the file cannot be read.
Reference load_sample_csv(const std::filesystem::path& file);

}  // namespace skyfit::refs
