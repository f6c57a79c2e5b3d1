// SPDX-License-Identifier: Apache-2.0
// A CSV of two columns, as the presets name them, becomes the table that the model takes. Format of
// the text: data_refs/csv.h; other columns are refused.
#pragma once

#include "model/atmosphere/table_format.h"

namespace skyfit::refs {

// Throws std::invalid_argument with one line that names source, line, column, value and what was
// expected.
TwoColumns parse_table_csv(std::string_view text, std::string_view source,
                           const TableFormat& format);

// Throws std::runtime_error when the file cannot be read. A skyfit::TableReader.
TwoColumns load_table_csv(const std::filesystem::path& file, const TableFormat& format);

}  // namespace skyfit::refs
