// SPDX-License-Identifier: Apache-2.0
// Columns of somebody's own become those that skyfit reads. A sidecar says which:
//   "columns": {"view_azimuth_deg": "Azi", "view_zenith_deg": {"column": "Elev", "times": -1,
//   "plus": 90},
//               "radiance_440": "#5"},
//   "delimiter": ";", "decimal_comma": true, "skip_lines": 3, "header": false
// A column is named as in the file, or by its number, "#1" the first. The columns made are those of
// a spectral scan (data_refs/spectral_scan_csv.h) or of a CSV of samples (data_refs/sample_csv.h).
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/base/preset_reader.h"

namespace skyfit::refs {

struct ColumnMapping {
  struct Column {
    std::string name, source;  // ours, theirs
    double times = 1, plus = 0;
  };
  std::vector<Column> columns;
  std::string delimiter = ",";  // ",", ";", "tab" or "space" (any number of them)
  bool decimal_comma = false;   // 3,14 is a number
  bool header = true;           // the first line names the columns
  int skip_lines = 0;           // before that

  bool has(std::string_view name) const;
};

// The names of the fields above.
inline constexpr std::string_view kMappingFields[] = {"columns", "delimiter", "decimal_comma",
                                                      "skip_lines", "header"};
// Throws std::invalid_argument with one line that names file, line, field and expectation.
ColumnMapping column_mapping(const PresetReader& sidecar);

// Mapped columns that are none of what is read: the time of each line, on the file's clock, and its
// date where the time has none.
inline constexpr std::string_view kMappedLocalDate = "local_date", kMappedLocalTime = "local_time";

// Columns that the lines do not have.
struct AddedColumns {
  std::vector<std::string> names;
  // Of a line and its fields of the time columns with T between; nothing where the line is to be
  // left out.
  std::function<std::optional<std::vector<std::string>>(const std::string& time, int line)> values;
  std::vector<std::string_view> time_columns = {};  // mapped columns that are read here only

  bool is_time(std::string_view column) const;
};

// The CSV that is read in the place of `text`, line by line, so that messages name lines of the
// file. Throws std::invalid_argument `source:line: ...` for a column that the file lacks, or a
// value that is no number.
std::string mapped_text(std::string_view text, std::string_view source,
                        const ColumnMapping& mapping, const AddedColumns& added);

}  // namespace skyfit::refs
