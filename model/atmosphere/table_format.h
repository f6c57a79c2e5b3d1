// SPDX-License-Identifier: Apache-2.0
// Functions that a preset gives as two columns of numbers, in itself or in a CSV beside it: what
// the columns are called and what they must hold. Nothing here reads files.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit {

// The argument, ascending, and the function's value at it.
struct TwoColumns {
  std::vector<double> x, y;

  friend bool operator==(const TwoColumns&, const TwoColumns&) = default;
};

// The first thing that is not as it must be: a value of one row, or something about the whole
// column that `found` describes.
struct TableFault {
  std::size_t column;  // 0: x, 1: y
  std::optional<std::size_t> row;
  std::string found, expectation;
};

struct TableFormat {
  std::array<std::string_view, 2> columns;
  std::optional<TableFault> (*fault)(const TwoColumns&);
};

// What every table must hold: as many values as arguments, at least two, ascending, the first one
// finite, or `first` where that is given.
std::optional<TableFault> ascending_fault(const TableFormat& format, const TwoColumns& table,
                                          std::optional<double> first);

// Throws std::invalid_argument, `column[row] = value: expected ...`, when there is a fault.
void expect_no_fault(const TableFormat& format, const TwoColumns& table);

// Reads the two columns from a file and throws one line that names it, where there is a fault also
// line, column, value and expectation.
using TableReader = std::function<TwoColumns(const std::filesystem::path&, const TableFormat&)>;

}  // namespace skyfit
