// SPDX-License-Identifier: Apache-2.0
#include "model/atmosphere/table_format.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

namespace skyfit {

std::optional<TableFault> ascending_fault(const TableFormat& format, const TwoColumns& table,
                                          std::optional<double> first) {
  const std::vector<double>& x = table.x;
  if (x.size() < 2) {
    return TableFault{0, {}, fmt::format("{} values", x.size()), "at least 2"};
  }
  constexpr std::size_t kMostRows = 100'000;
  if (x.size() > kMostRows) {
    return TableFault{
        0, {}, fmt::format("{} values", x.size()), fmt::format("at most {}", kMostRows)};
  }
  if (table.y.size() != x.size()) {
    return TableFault{1,
                      {},
                      fmt::format("{} values", table.y.size()),
                      fmt::format("as many as of {}, {}", format.columns[0], x.size())};
  }
  if (first && x[0] != *first) return TableFault{0, 0, {}, fmt::format("{}, the first", *first)};
  if (!std::isfinite(x[0])) return TableFault{0, 0, {}, "a finite number"};
  for (std::size_t i = 1; i < x.size(); ++i) {
    if (!(x[i] > x[i - 1]) || !std::isfinite(x[i])) {
      return TableFault{0, i, {}, fmt::format("more than {}, the one before", x[i - 1])};
    }
  }
  return {};
}

void expect_no_fault(const TableFormat& format, const TwoColumns& table) {
  const std::optional<TableFault> fault = format.fault(table);
  if (!fault) return;
  const std::string_view name = format.columns[fault->column];
  if (!fault->row) {
    throw std::invalid_argument(
        fmt::format("{}: {}: expected {}", name, fault->found, fault->expectation));
  }
  const double value = (fault->column == 0 ? table.x : table.y)[*fault->row];
  throw std::invalid_argument(
      fmt::format("{}[{}] = {}: expected {}", name, *fault->row, value, fault->expectation));
}

}  // namespace skyfit
