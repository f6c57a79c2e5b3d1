// SPDX-License-Identifier: Apache-2.0
#include "data_refs/scan_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "data_refs/csv.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kBlank = " \t\r";

std::string_view last_word(std::string_view text) {
  text = text.substr(0, text.find_last_not_of(kBlank) + 1);
  return text.substr(text.find_last_of(kBlank) + 1);
}

std::string_view first_word(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
  return text.substr(0, text.find_first_of(kBlank));
}

// The words before and behind each sign of equality.
void read_facts(const CommentLine& comment, std::string_view source, ScanHeader& header) {
  const std::string_view text = comment.text;
  for (std::size_t at = text.find('='); at != text.npos; at = text.find('=', at + 1)) {
    const std::string name(last_word(text.substr(0, at))), value(first_word(text.substr(at + 1)));
    for (const ImportOptionRow& row : import_option_table()) {
      if (row.name != name) continue;
      if (!row.set(value, header.facts)) {
        fail_at(source, comment.line,
                fmt::format("{} = {}: expected {}", name, value, row.expectation));
      }
      header.line_of[name] = comment.line;
    }
  }
}

}  // namespace

std::string ScanHeader::place(std::string_view source, std::string_view name) const {
  const auto found = line_of.find(name);
  return found == line_of.end() ? std::string(source) : fmt::format("{}:{}", source, found->second);
}

std::string_view first_line(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), line.size() + 1));
    const std::size_t begin = line.find_first_not_of(kBlank);
    if (begin == line.npos || line[begin] == '#') continue;
    return line.substr(begin, line.find_last_not_of(kBlank) - begin + 1);
  }
  return {};
}

ScanHeader scan_header(std::string_view text, std::string_view source) {
  ScanHeader header;
  std::istringstream lines{std::string(text)};
  std::string content;
  for (int line = 1; std::getline(lines, content); ++line) {
    const std::size_t begin = content.find_first_not_of(kBlank);
    if (begin == std::string::npos) continue;
    if (content[begin] != '#') break;
    header.comments.push_back({line, content.substr(begin + 1)});
    read_facts(header.comments.back(), source, header);
  }
  return header;
}

}  // namespace skyfit::refs
