// SPDX-License-Identifier: Apache-2.0
// A strict reader of comma-separated values (RFC 4180 on one line per record) for every table that
// skyfit reads. The first record names the columns. Accepted: CRLF, a byte order mark, blank lines,
// lines that start with #, quoted fields with "" for a quote, spaces around fields, empty fields
// without a name at the end of a line. Every complaint
// is one std::invalid_argument of one line, `source:line: column = value: expected ...`.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace skyfit::refs {

struct CsvRecord {
  int line;  // 1 is the first of the file
  std::vector<std::string> fields;
};

class CsvTable {
 public:
  // Throws when there is no header, a column name is empty or comes twice, a quote is not closed,
  // or a record has another number of fields than the header.
  CsvTable(std::string_view text, std::string_view source);

  const std::string& source() const { return source_; }
  int header_line() const { return header_.line; }
  const std::vector<std::string>& columns() const { return header_.fields; }
  const std::vector<CsvRecord>& records() const { return records_; }
  bool has(std::string_view column) const { return index_.contains(column); }

  // The column must exist.
  const std::string& text(const CsvRecord& record, std::string_view column) const;
  // Throws unless the whole field is a finite number.
  double number(const CsvRecord& record, std::string_view column) const;
  // Throws unless the whole field is a number; nan and inf are.
  double any_number(const CsvRecord& record, std::string_view column) const;

  [[noreturn]] void fail_header(std::string_view message) const;
  [[noreturn]] void fail_value(const CsvRecord& record, std::string_view column,
                               std::string_view expectation) const;

 private:
  std::string source_;
  CsvRecord header_{};
  std::vector<CsvRecord> records_;
  std::map<std::string, std::size_t, std::less<>> index_;
};

// The fields of one line, for files that are no table. Throws as CsvTable does.
std::vector<std::string> csv_fields(std::string_view content, std::string_view source, int line,
                                    char delimiter = ',');

// "semicolons" or "tabs" where they separate the fields of a line; empty where it is commas.
std::string_view other_delimiter(std::string_view line);

// The number that is the whole of a field, nan and inf included; nothing when it is none.
std::optional<double> csv_number(std::string_view field);

// Throws std::invalid_argument `source:line: message`, on one line and without control characters.
[[noreturn]] void fail_at(std::string_view source, int line, std::string_view message);

}  // namespace skyfit::refs
