// SPDX-License-Identifier: Apache-2.0
#include "data_refs/import_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "data_refs/csv.h"
#include "model/base/input_file.h"
#include "model/base/preset_reader.h"
#include "model/base/text.h"

namespace skyfit::refs {
namespace {

constexpr std::string_view kExclude = "exclude_samples", kNote = "note";

void expect_samples(const ImportOptions& options) {
  for (const ExcludedSample& excluded : options.exclude_samples) {
    if (excluded.sample >= 0) continue;
    throw std::invalid_argument(fmt::format("{} = {}: must be >= 0", kExclude, excluded.sample));
  }
}

std::vector<ExcludedSample> exclusions(const PresetReader& reader) {
  std::vector<ExcludedSample> result;
  for (const auto& [name, ignored] : reader.value().items()) {
    int sample = -1;
    const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), sample);
    const std::string reason = reader.text(name);
    if (error != std::errc{} || end != name.data() + name.size() || sample < 0 || reason.empty())
      reader.fail_value(name, "the number of a sample and the reason for leaving it out");
    result.push_back({sample, reason});
  }
  return result;
}

}  // namespace

void validate(const ImportOptions& options) {
  for (const ImportOptionRow& row : import_option_table()) {
    const auto fail = [&](std::string_view value) {
      throw std::invalid_argument(
          fmt::format("{} = {}: must be {}", row.name, value, row.expectation));
    };
    if (row.number != nullptr && options.*row.number && !row.accepts_number(*(options.*row.number)))
      fail(fmt::format("{:.9g}", *(options.*row.number)));
    if (row.text != nullptr && options.*row.text && !row.accepts_text(*(options.*row.text)))
      fail(*(options.*row.text));
  }
  expect_samples(options);
}

ImportOptions overlaid(const ImportOptions& first, const ImportOptions& second) {
  ImportOptions result = first;
  for (const ImportOptionRow& row : import_option_table()) {
    if (row.number != nullptr && !(result.*row.number)) result.*row.number = second.*row.number;
    if (row.text != nullptr && !(result.*row.text)) result.*row.text = second.*row.text;
  }
  if (!result.columns) result.columns = second.columns;
  result.exclude_samples.insert(result.exclude_samples.end(), second.exclude_samples.begin(),
                                second.exclude_samples.end());
  return result;
}

ImportOptions parse_sidecar(std::string_view json, std::string_view source) {
  const PresetDocument document(json, source);
  const PresetReader root = document.root();
  std::vector<std::string_view> names = {kExclude, kNote};
  for (const ImportOptionRow& row : import_option_table()) names.push_back(row.name);
  names.insert(names.end(), std::begin(kMappingFields), std::end(kMappingFields));
  root.expect_only(names);
  ImportOptions options;
  for (const ImportOptionRow& row : import_option_table()) {
    if (!root.has(row.name)) continue;
    bool accepted = false;
    if (row.number != nullptr) {
      options.*row.number = root.number(row.name);
      accepted = row.accepts_number(*(options.*row.number));
    } else {
      options.*row.text = root.text(row.name);
      accepted = row.accepts_text(*(options.*row.text));
    }
    if (!accepted) root.fail_value(row.name, row.expectation);
  }
  if (std::ranges::any_of(kMappingFields, [&](std::string_view name) { return root.has(name); }))
    options.columns = column_mapping(root);
  if (root.has(kExclude)) options.exclude_samples = exclusions(root.object(kExclude));
  return options;
}

ImportOptions load_sidecar(const std::filesystem::path& sidecar, NamedFiles named) {
  ImportOptions options =
      parse_sidecar(read_text_file(sidecar, "a sidecar (JSON)"), sidecar.string());
  for (const ImportOptionRow& row : import_option_table()) {
    if (!row.is_file || !row.is_set(options)) continue;
    std::string& name = *(options.*row.text);
    const auto file = named_file(sidecar.parent_path(), name, named);
    if (!file)
      throw std::invalid_argument(fmt::format("{}: {} = {}: expected {}", sidecar.string(),
                                              row.name, in_quotes(name), kNamedFile));
    name = file->string();
  }
  return options;
}

ImportOptions with_sidecar(const ImportOptions& options, const std::filesystem::path& file) {
  std::filesystem::path beside = file;
  if (beside.filename().empty()) beside = beside.parent_path();  // "folder/"
  beside += ".sidecar.json";
  if (options.sidecar)
    return overlaid(options, load_sidecar(*options.sidecar, options.named_files));
  return std::filesystem::exists(beside)
             ? overlaid(options, load_sidecar(beside, options.named_files))
             : options;
}

}  // namespace skyfit::refs
