// SPDX-License-Identifier: Apache-2.0
// What the head of a file of measurements says of its scan, as `# name=value name = value` in
// comment lines with the names of import_option_table(); other words are for the reader.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "data_refs/import_options.h"

namespace skyfit::refs {

struct CommentLine {
  int line;
  std::string text;  // after the #
};

struct ScanHeader {
  std::vector<CommentLine> comments;
  ImportOptions facts;
  std::map<std::string, int, std::less<>> line_of;  // of each fact

  // `source:line` of a fact, or the source alone when the fact comes from elsewhere.
  std::string place(std::string_view source, std::string_view name) const;
};

// The first line of a text that is neither blank nor a comment, without blanks around it.
std::string_view first_line(std::string_view text);

// Throws std::invalid_argument `source:line: name = value: expected ...`.
ScanHeader scan_header(std::string_view text, std::string_view source);

}  // namespace skyfit::refs
