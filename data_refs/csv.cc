// SPDX-License-Identifier: Apache-2.0
#include "data_refs/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "model/base/input_file.h"
#include "model/base/text.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kBlank = " \r";  // a tab may be the delimiter

// Reads the quoted field at the front of `rest` and removes it, up to the delimiter or the end.
std::string take_quoted(std::string_view& rest, std::string_view source, int line, char delimiter) {
  std::string field;
  std::size_t i = 1;
  for (;; ++i) {
    if (i == rest.size())
      fail_at(source, line, "expected a closing quote before the end of the line");
    if (rest[i] == '"') {
      if (i + 1 == rest.size() || rest[i + 1] != '"') break;
      ++i;
    }
    field += rest[i];
  }
  rest.remove_prefix(i + 1);
  rest.remove_prefix(std::min(rest.find_first_not_of(kBlank), rest.size()));
  if (!rest.empty() && rest.front() != delimiter)
    fail_at(source, line, fmt::format("expected \"{}\" after a closing quote", delimiter));
  return field;
}

// Spreadsheets end lines with the commas of columns without a name or a value.
void drop_empty(std::vector<std::string>& fields, std::size_t least) {
  while (fields.size() > least && fields.back().empty()) fields.pop_back();
}

}  // namespace

void fail_at(std::string_view source, int line, std::string_view message) {
  throw std::invalid_argument(fmt::format("{}:{}: {}", source, line, printable(message)));
}

std::vector<std::string> csv_fields(std::string_view rest, std::string_view source, int line,
                                    char delimiter) {
  std::vector<std::string> fields;
  for (;;) {
    const std::size_t start = rest.find_first_not_of(kBlank);
    if (start != rest.npos && rest[start] == '"') {
      rest.remove_prefix(start);
      fields.push_back(take_quoted(rest, source, line, delimiter));
    } else {
      const std::size_t end = rest.find(delimiter);
      fields.emplace_back(trim(rest.substr(0, end)));
      rest = end == std::string_view::npos ? std::string_view{} : rest.substr(end);
    }
    if (rest.empty()) return fields;
    rest.remove_prefix(1);  // the delimiter
  }
}

std::string_view other_delimiter(std::string_view line) {
  const auto semicolons = std::ranges::count(line, ';'), tabs = std::ranges::count(line, '\t'),
             commas = std::ranges::count(line, ',');
  constexpr int kFew = 2;
  if (semicolons >= kFew) return "semicolons";
  return tabs >= kFew && tabs > commas ? "tabs" : "";
}

std::optional<double> csv_number(std::string_view field) {
  if (field.starts_with('+') && !field.starts_with("+-")) field.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size()) return {};
  return value;
}

CsvTable::CsvTable(std::string_view text, std::string_view source) : source_(source) {
  text = without_byte_order_mark(text);
  for (int line = 1; !text.empty(); ++line) {
    const std::size_t end = text.find('\n');
    const std::string_view content = trim(text.substr(0, end));
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    if (content.empty() || content.front() == '#') continue;
    CsvRecord record{line, csv_fields(content, source_, line)};
    if (header_.line == 0) {
      header_ = std::move(record);
      drop_empty(header_.fields, 1);
      continue;
    }
    drop_empty(record.fields, header_.fields.size());
    if (record.fields.size() != header_.fields.size()) {
      fail_at(
          source_, line,
          fmt::format("expected {} fields, got {}", header_.fields.size(), record.fields.size()));
    }
    records_.push_back(std::move(record));
  }
  if (header_.line == 0)
    throw std::invalid_argument(source_ + ": is empty, expected a line of column names");
  for (std::size_t i = 0; i < header_.fields.size(); ++i) {
    const std::string& name = header_.fields[i];
    if (name.empty()) fail_header(fmt::format("column {} has no name", i + 1));
    if (!index_.emplace(name, i).second)
      fail_header(fmt::format("column {}: expected once, found twice", excerpt(name)));
  }
}

const std::string& CsvTable::text(const CsvRecord& record, std::string_view column) const {
  return record.fields[index_.find(column)->second];
}

double CsvTable::number(const CsvRecord& record, std::string_view column) const {
  const std::optional<double> value = csv_number(text(record, column));
  if (!value || !std::isfinite(*value)) fail_value(record, column, "a finite number");
  return *value;
}

double CsvTable::any_number(const CsvRecord& record, std::string_view column) const {
  const std::optional<double> value = csv_number(text(record, column));
  if (!value) fail_value(record, column, "a number, or nan where there is none");
  return *value;
}

void CsvTable::fail_header(std::string_view message) const {
  fail_at(source_, header_.line, message);
}

void CsvTable::fail_value(const CsvRecord& record, std::string_view column,
                          std::string_view expectation) const {
  fail_at(source_, record.line,
          fmt::format("{} = {}: expected {}", excerpt(column), in_quotes(text(record, column)),
                      expectation));
}

}  // namespace skyfit::refs
