// SPDX-License-Identifier: Apache-2.0
// The percent format: a C++ file whose lines `// %%`, `// %% [markdown]` and `// %% [hidden]` begin
// cells.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace skyfit::notebook {

enum class CellKind {
  kCode,
  kMarkdown,  // comment lines; their `// ` is taken off
  kHidden     // compiled, not shown: the brackets around the cells
};

struct Cell {
  CellKind kind;
  int first_line;  // of the marker, from 1
  int last_line;
  std::string
      source;  // as shown: without marker, blank ends, common indentation and `page.cell();`
};

// Lines before the first marker belong to no cell. Throws std::invalid_argument `name:line: ...`
// for an unknown kind of cell, a markdown cell that holds code, an empty cell, or a file without a
// code cell.
std::vector<Cell> parse_percent(std::string_view text, std::string_view name);

}  // namespace skyfit::notebook
