// SPDX-License-Identifier: Apache-2.0
#include "data_refs/patch_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "data_refs/csv.h"
#include "data_refs/patch_scan.h"
#include "data_refs/scan_header.h"

namespace skyfit::refs {
namespace {

// Without the commas that spreadsheets end it with.
std::string_view without_end(std::string_view line) {
  return line.substr(0, line.find_last_not_of(", \t\r") + 1);
}

std::vector<double> read_values(std::string_view text, std::string_view source) {
  std::vector<double> values;
  std::istringstream lines{std::string(text)};
  std::string content;
  for (int line = 1; std::getline(lines, content); ++line) {
    if (first_line(content).empty()) continue;
    for (const std::string& field : csv_fields(without_end(content), source, line)) {
      const std::optional<double> value = csv_number(field);
      if (!value) {
        fail_at(source, line,
                fmt::format("patch {} = \"{}\": expected a number, or nan where there "
                            "is none",
                            values.size() + 1, field));
      }
      values.push_back(*value);
    }
  }
  if (values.size() != kPatches) {
    throw std::invalid_argument(fmt::format("{}: {} numbers: expected the {} patches of a sky scan",
                                            source, values.size(), kPatches));
  }
  return values;
}

}  // namespace

bool is_patch_csv(std::string_view line) {
  if (line.empty() || line.find('"') != line.npos) return false;
  return std::ranges::all_of(csv_fields(without_end(line), {}, 0), [](const std::string& field) {
    return csv_number(field).has_value();
  });
}

Reference parse_patch_csv(std::string_view text, std::string_view source,
                          const ImportOptions& options) {
  const ScanHeader header = scan_header(text, source);
  const ImportOptions facts = overlaid(options, header.facts);
  const Unit unit =
      stated_unit(header, options, source, {Quantity::kLuminance, Quantity::kRelativeLuminance});
  const PatchScan scan{std::filesystem::path(source).filename().string(),
                       sun_of_scan(facts, header.place(source, "sun_zenith_deg")),
                       read_values(text, source),
                       {}};
  return patch_reference(std::string(source), unit, facts, {&scan, 1});
}

}  // namespace skyfit::refs
