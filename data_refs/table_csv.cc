// SPDX-License-Identifier: Apache-2.0
#include "data_refs/table_csv.h"

#include <fmt/format.h>

#include <algorithm>

#include "data_refs/csv.h"
#include "model/base/input_file.h"
#include "model/base/text.h"

namespace skyfit::refs {

TwoColumns parse_table_csv(std::string_view text, std::string_view source,
                           const TableFormat& format) {
  const CsvTable csv(text, source);
  const auto& [x, y] = format.columns;
  if (!csv.has(x) || !csv.has(y) || csv.columns().size() != format.columns.size()) {
    csv.fail_header(fmt::format("columns {}: expected {}, {}",
                                excerpt(fmt::format("{}", fmt::join(csv.columns(), ", "))), x, y));
  }
  TwoColumns table;
  for (const CsvRecord& record : csv.records()) {
    table.x.push_back(csv.number(record, x));
    table.y.push_back(csv.number(record, y));
  }
  if (const auto fault = format.fault(table)) {
    const std::string_view column = format.columns[fault->column];
    if (fault->row) csv.fail_value(csv.records()[*fault->row], column, fault->expectation);
    csv.fail_header(fmt::format("{}: {}: expected {}", column, fault->found, fault->expectation));
  }
  return table;
}

TwoColumns load_table_csv(const std::filesystem::path& file, const TableFormat& format) {
  return parse_table_csv(read_text_file(file, "a CSV of a table"), file.string(), format);
}

}  // namespace skyfit::refs
