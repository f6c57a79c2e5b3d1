// SPDX-License-Identifier: Apache-2.0
#include "data_refs/column_mapping.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include "data_refs/csv.h"
#include "data_refs/sample_csv_columns.h"
#include "model/base/text.h"

namespace skyfit::refs {
namespace {

constexpr std::array<std::pair<std::string_view, char>, 4> kDelimiters = {
    {{",", ','}, {";", ';'}, {"tab", '\t'}, {"space", ' '}}};

char delimiter_of(const ColumnMapping& mapping) {
  return std::ranges::find(kDelimiters, mapping.delimiter,
                           &std::pair<std::string_view, char>::first)
      ->second;
}

std::vector<std::string> fields_of(const std::string& line, char delimiter, std::string_view source,
                                   int number) {
  if (delimiter != ' ') return csv_fields(line, source, number, delimiter);
  std::vector<std::string> fields;
  std::istringstream words(line);
  for (std::string word; words >> word;) fields.push_back(word);
  return fields;
}

// Where each column of the mapping stands.
std::vector<std::size_t> places(const ColumnMapping& mapping, const std::vector<std::string>& names,
                                std::string_view source, int line) {
  std::vector<std::size_t> result;
  for (const ColumnMapping::Column& column : mapping.columns) {
    if (column.source.starts_with('#')) {
      const std::optional<double> number = csv_number(column.source.substr(1));
      result.push_back(static_cast<std::size_t>(number.value_or(1)) - 1);
      continue;
    }
    const auto found = std::ranges::find(names, column.source);
    if (std::ranges::count(names, column.source) > 1)
      fail_at(source, line,
              fmt::format("{} columns {} (columns.{} of the sidecar): expected one, or its number "
                          "such as #3",
                          std::ranges::count(names, column.source), in_quotes(column.source),
                          column.name));
    if (found == names.end())
      fail_at(source, line,
              fmt::format("expected a column {} (columns.{} of the sidecar), got {}",
                          in_quotes(column.source), column.name,
                          excerpt(fmt::format("{}", fmt::join(names, ", ")))));
    result.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  return result;
}

bool is_radiance(std::string_view column) { return column.starts_with("radiance_"); }

bool is_sample_value(std::string_view column) {
  return std::ranges::find(sample_csv::kValueColumns, column, &sample_csv::ValueColumn::name) !=
         sample_csv::kValueColumns.end();
}

// As loggers and spreadsheets write it.
bool is_missing(std::string_view field) {
  constexpr std::array<std::string_view, 6> kNone = {"", "-", "--", "NA", "N/A", "NaN"};
  const std::optional<double> number = csv_number(field);
  return std::ranges::find(kNone, field) != kNone.end() ||
         (number && (std::isnan(*number) || *number == -999 || *number == -9999));
}

// Why a sample with this value in the column cannot be used; empty where it can.
std::string_view flaw_of(std::string_view column, std::string_view value) {
  const std::optional<double> number = csv_number(value);
  if (!number) return {};
  if (is_sample_value(column) && std::isnan(*number)) return "missing";
  if (is_sample_value(column) && !(*number > 0)) return "not positive";
  if (column == sample_csv::kViewZenith && !(*number < 90)) return "outside the sky";
  return {};
}

std::string value_of(const ColumnMapping::Column& column, std::string field, bool decimal_comma,
                     std::string_view source, int line) {
  if (decimal_comma && field.find('.') != field.npos &&
      field.find_first_not_of("+-0123456789.,") == field.npos)
    fail_at(source, line,
            fmt::format("{} = {}: expected a decimal comma and no points, as decimal_comma says",
                        column.source, in_quotes(field)));
  if (decimal_comma) std::ranges::replace(field, ',', '.');
  if ((is_radiance(column.name) || is_sample_value(column.name)) && is_missing(field)) return "nan";
  const std::optional<double> number = csv_number(field);
  if (!number) {
    if (column.times == 1 && column.plus == 0) return csv_field(field);  // a label, say
    fail_at(source, line,
            fmt::format("{} = {}: expected a number", column.source, in_quotes(field)));
  }
  return fmt::format("{}", column.times * *number + column.plus);
}

}  // namespace

bool ColumnMapping::has(std::string_view name) const {
  return std::ranges::count(columns, name, &Column::name) > 0;
}

bool AddedColumns::is_time(std::string_view column) const {
  return std::ranges::count(time_columns, column) > 0;
}

ColumnMapping column_mapping(const PresetReader& sidecar) {
  ColumnMapping mapping;
  const PresetReader columns = sidecar.object("columns");
  for (const auto& [name, value] : columns.value().items()) {
    ColumnMapping::Column column{name, {}, 1, 0};
    if (value.is_object()) {
      const PresetReader object = columns.object(name);
      object.expect_only({"column", "times", "plus"});
      column.source = object.text("column");
      if (object.has("times")) column.times = object.number("times");
      if (object.has("plus")) column.plus = object.number("plus");
    } else {
      column.source = columns.text(name);
    }
    const std::optional<double> number =
        column.source.starts_with('#') ? csv_number(column.source.substr(1)) : std::nullopt;
    constexpr double kMostColumns = 100'000;
    if (column.source.starts_with('#') &&
        !(number && *number >= 1 && *number <= kMostColumns && *number == std::floor(*number)))
      columns.fail_value(name, "a column's name, or its number such as #3");
    mapping.columns.push_back(std::move(column));
  }
  if (mapping.columns.empty()) sidecar.fail_value("columns", "at least one column");
  if (sidecar.has("delimiter")) {
    mapping.delimiter = sidecar.text("delimiter");
    if (std::ranges::count(kDelimiters, mapping.delimiter,
                           &std::pair<std::string_view, char>::first) == 0)
      sidecar.fail_value("delimiter", "\",\", \";\", \"tab\" or \"space\"");
  }
  if (sidecar.has("decimal_comma")) mapping.decimal_comma = sidecar.flag("decimal_comma");
  if (sidecar.has("header")) mapping.header = sidecar.flag("header");
  if (sidecar.has("skip_lines")) {
    constexpr int kMostLines = 1'000'000;
    const double lines = sidecar.number("skip_lines");
    if (lines < 0 || lines > kMostLines || lines != std::floor(lines))
      sidecar.fail_value("skip_lines", "a whole number >= 0");
    mapping.skip_lines = static_cast<int>(lines);
  }
  if (mapping.decimal_comma && mapping.delimiter == ",")
    sidecar.fail_value("decimal_comma", "another delimiter than a comma with it");
  if (!mapping.header && std::ranges::any_of(mapping.columns, [](const auto& column) {
        return !column.source.starts_with('#');
      }))
    sidecar.fail_value("columns", "numbers such as #3 where no line names the columns");
  return mapping;
}

std::string mapped_text(std::string_view text, std::string_view source,
                        const ColumnMapping& mapping, const AddedColumns& added) {
  const char delimiter = delimiter_of(mapping);
  // A spectral scan numbers its samples.
  const bool numbered =
      !mapping.has("sample") && std::ranges::any_of(mapping.columns, [](const auto& column) {
        return is_radiance(column.name);
      });
  // Where the file has no weights, what cannot be used has none.
  const bool weighted = !mapping.has(sample_csv::kWeight) && !mapping.has(sample_csv::kReason) &&
                        std::ranges::any_of(mapping.columns, [](const auto& column) {
                          return is_sample_value(column.name);
                        });
  std::string names = numbered ? "sample" : "";
  const auto add = [&](const std::string& name) {
    if (!names.empty()) names += ',';
    names += csv_field(name);
  };
  for (const ColumnMapping::Column& column : mapping.columns) {
    if (!added.is_time(column.name)) add(column.name);
  }
  std::ranges::for_each(added.names, add);
  if (weighted) names += fmt::format(",{},{}", sample_csv::kWeight, sample_csv::kReason);

  std::string result;
  std::vector<std::size_t> place;
  bool named = false;
  int number = 0, sample = 0;
  std::istringstream lines{std::string(text)};
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const bool skipped = number <= mapping.skip_lines;
    const std::string_view content = trim(line);
    if (skipped || content.empty() || content.starts_with('#')) {
      result += skipped ? "#\n" : std::string(content) + "\n";
      continue;
    }
    const std::vector<std::string> fields = fields_of(line, delimiter, source, number);
    if (std::ranges::all_of(fields, &std::string::empty)) {
      result += '\n';
      continue;
    }
    if (!named) {
      place = places(mapping, fields, source, number);
      named = true;
      result += names;
      if (mapping.header) {
        result += '\n';
        continue;
      }
      // The names take the place of a line that was skipped, or lines are counted one too far.
      if (result.starts_with("#\n")) result.erase(0, 2);
      result += '\n';
    }
    std::vector<std::string> values;
    std::map<std::string_view, std::string> times;  // by their columns
    std::string_view flaw;
    for (std::size_t i = 0; i < place.size(); ++i) {
      const ColumnMapping::Column& column = mapping.columns[i];
      if (place[i] >= fields.size())
        fail_at(source, number,
                fmt::format("expected at least {} columns, got {}", place[i] + 1, fields.size()));
      const std::string& field = fields[place[i]];
      if (added.is_time(column.name)) {
        times[column.name] = field;
        continue;
      }
      values.push_back(value_of(column, field, mapping.decimal_comma, source, number));
      if (flaw.empty()) flaw = flaw_of(column.name, values.back());
    }
    if (numbered) values.insert(values.begin(), fmt::format("{}", sample++));
    if (added.values) {
      std::vector<std::string> parts;
      for (const std::string_view column : added.time_columns) parts.push_back(times[column]);
      const auto further = added.values(fmt::format("{}", fmt::join(parts, "T")), number);
      if (!further) {
        result += '\n';
        continue;
      }
      for (const std::string& value : *further) values.push_back(csv_field(value));
    }
    if (weighted) values.push_back(fmt::format("{},{}", flaw.empty() ? 1 : 0, flaw));
    result += fmt::format("{}\n", fmt::join(values, ","));
  }
  return result;
}

}  // namespace skyfit::refs
