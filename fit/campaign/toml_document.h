// SPDX-License-Identifier: Apache-2.0
// TOML 1.0 as the document that JSON of the same names and values would be.
#pragma once

#include <string_view>

#include "model/base/preset_reader.h"

namespace skyfit::fit {

// Throws std::invalid_argument `source:line: ...` for what is not TOML, and for the values that
// JSON has no place for: dates, times, nan and inf.
PresetDocument toml_document(std::string_view text, std::string_view source);

}  // namespace skyfit::fit
