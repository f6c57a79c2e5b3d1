// SPDX-License-Identifier: Apache-2.0
// Luminances of the 145 patches (patch_scan.h) as nothing but numbers: one line of 145 or 145 lines
// of one. Comment lines before them, a sidecar or options state the unit, and the time and the site
// or the sun (scan_header.h). Samples are numbered from 1, as the patches are.
#pragma once

#include <string_view>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

// Whether the first line that is no comment holds nothing but numbers.
bool is_patch_csv(std::string_view line);

// Throws std::invalid_argument `source:line: field = value: expected ...`.
Reference parse_patch_csv(std::string_view text, std::string_view source,
                          const ImportOptions& options);

}  // namespace skyfit::refs
