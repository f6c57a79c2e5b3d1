// SPDX-License-Identifier: Apache-2.0
// The CSV of the sky scanner EKO MS-321LR (instruction manual, section 7-4). Nine header lines:
// title, firmware, `Date,YYYY/MM/DD`, comment, `Lon140 d 8.0 m`, `La36 d 3.0 m`,
// `Timezone,UTC +9:00`, `Unit,kcd/m^2,...` (of the luminances first), and the numbers of the
// channels. Then, in turn, rows L of luminances and R of radiances, which are not read: start, end,
// the 145 patches (patch_scan.h), azimuth and altitude of the sun. Every row L is a scan under the
// sun of its middle; the stated altitude must agree.
#pragma once

#include <string_view>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

bool is_eko_csv(std::string_view first_line);

// Throws std::invalid_argument `source:line: field = value: expected ...`.
Reference parse_eko_csv(std::string_view text, std::string_view source,
                        const ImportOptions& options);

}  // namespace skyfit::refs
