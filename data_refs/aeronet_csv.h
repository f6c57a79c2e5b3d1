// SPDX-License-Identifier: Apache-2.0
// Sky radiances of AERONET (aeronet_table.h): almucantars, whose view zenith angle is the sun's,
// and principal planes, whose angles count from the sun, upward > 0. A hybrid scan does not say
// where it looks and is left out. -999 stands for a missing value; a line that has one value
// throughout holds no measurement. Every line is one wavelength with its own time and sun; lines of
// one type that follow each other within 15 min without repeating a wavelength are a scan. A line
// that cannot be used is left out, and a note says why.
#pragma once

#include <string_view>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

bool is_aeronet_csv(std::string_view text);

// Throws std::invalid_argument `source:line: column = value: expected ...` when no line is of use.
Reference parse_aeronet_csv(std::string_view text, std::string_view source,
                            const ImportOptions& options);

}  // namespace skyfit::refs
