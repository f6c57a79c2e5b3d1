// SPDX-License-Identifier: Apache-2.0
// Names of how tables are kept, as options give them. Throws UsageError that lists them.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/arguments.h"
#include "model/tables/table_precision.h"

namespace skyfit::cli {

// "full|medium", as a help text shows choices.
template <class Row>
std::string names_of(std::span<const Row> rows) {
  std::string names;
  for (const Row& row : rows) names += (names.empty() ? "" : "|") + std::string(row.name);
  return names;
}

// The row of a registry by its name.
template <class Row>
const Row& entry_named(std::string_view option, std::string_view name, std::span<const Row> rows) {
  std::vector<std::string_view> names;
  for (const Row& row : rows) {
    if (row.name == name) return row;
    names.push_back(row.name);
  }
  throw UsageError(option, name, fmt::format("expected one of {}", fmt::join(names, ", ")));
}

inline TablePrecision parse_table_precision(std::string_view option, std::string_view name) {
  return entry_named(option, name, table_precisions()).precision;
}

inline TableSizes parse_table_sizes(std::string_view option, std::string_view name) {
  return entry_named(option, name, table_sizes()).sizes;
}

}  // namespace skyfit::cli
