// SPDX-License-Identifier: Apache-2.0
#include "data_refs/import_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "data_refs/civil_time.h"
#include "data_refs/csv.h"
#include "data_refs/units.h"
#include "model/preset_reader.h"

namespace skyfit::refs {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSmallest = std::numeric_limits<double>::min();
constexpr std::string_view kExclude = "exclude_samples", kNote = "note";

using Options = ImportOptions;

std::vector<ImportOptionRow> make_table() {
  const auto number = [](std::string_view name, std::optional<double> Options::*member,
                         double lower, double upper, std::string_view expectation,
                         std::string_view meaning, bool on_command_line = true) {
    return ImportOptionRow{name,  expectation, meaning, member,
                           lower, upper,       nullptr, on_command_line};
  };
  const auto text = [](std::string_view name, std::optional<std::string> Options::*member,
                       std::string_view expectation, std::string_view meaning) {
    return ImportOptionRow{name, expectation, meaning, nullptr, 0, 0, member, true};
  };
  static const std::string unit_list = "one of " + unit_names();
  return {
      text("unit", &Options::unit, unit_list, "Unit of the values"),
      text("local_time", &Options::local_time, "YYYY-MM-DDTHH:MM:SS",
           "Date and time of the scan on the clock of the site"),
      number("utc_offset_h", &Options::utc_offset_h, -14, 14, "-14 to 14",
             "Hours that this clock is ahead of UTC"),
      number("latitude_deg", &Options::latitude_deg, -90, 90, "-90 to 90",
             "Of the site, north > 0"),
      number("longitude_deg", &Options::longitude_deg, -180, 360, "-180 to 360",
             "Of the site, east > 0"),
      number("elevation_m", &Options::elevation_m, -500, 9000, "-500 to 9000",
             "Of the site above the sea"),
      number("sun_zenith_deg", &Options::sun_zenith_deg, 0, 180, "0 to 180",
             "Of the sun, where time and site are not known", false),
      number("sun_azimuth_deg", &Options::sun_azimuth_deg, -360, 360, "-360 to 360",
             "Of the sun, clockwise from north", false),
      text("azimuth_zero", &Options::azimuth_zero, "north or south",
           "Where the azimuths of the file start"),
      text("azimuth_turns", &Options::azimuth_turns, "clockwise or counter-clockwise",
           "Seen from above"),
      number("saturation", &Options::saturation, kSmallest, kInfinity, "a number > 0",
             "Values from here on, in the unit of the file, are not used"),
      number("near_sun_deg", &Options::near_sun_deg, 0, 180, "0 to 180",
             "Samples closer to the sun are not used"),
      number("band_nm", &Options::band_nm, 1, 100, "1 to 100",
             "Width of the bands over which a folder of spectra is averaged, else 10"),
  };
}

bool is_accepted(const ImportOptionRow& row, double value) {
  return std::isfinite(value) && value >= row.lower && value <= row.upper;
}

bool is_accepted(const ImportOptionRow& row, const std::string& text) {
  if (row.name == "unit") return find_unit(text).has_value();
  if (row.name == "local_time") return instant(text, 0).has_value();
  if (row.name == "azimuth_zero") return text == "north" || text == "south";
  return text == "clockwise" || text == "counter-clockwise";
}

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

std::span<const ImportOptionRow> import_option_table() {
  static const std::vector<ImportOptionRow> table = make_table();
  return table;
}

bool set_import_option(const ImportOptionRow& row, std::string_view text, ImportOptions& options) {
  if (row.text != nullptr) {
    options.*row.text = text;
    return is_accepted(row, *(options.*row.text));
  }
  const std::optional<double> value = csv_number(text);
  options.*row.number = value;
  return value && is_accepted(row, *value);
}

void validate(const ImportOptions& options) {
  for (const ImportOptionRow& row : import_option_table()) {
    const auto fail = [&](std::string_view value) {
      throw std::invalid_argument(
          fmt::format("{} = {}: must be {}", row.name, value, row.expectation));
    };
    if (row.number != nullptr && options.*row.number && !is_accepted(row, *(options.*row.number)))
      fail(fmt::format("{:.9g}", *(options.*row.number)));
    if (row.text != nullptr && options.*row.text && !is_accepted(row, *(options.*row.text)))
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
  result.exclude_samples.insert(result.exclude_samples.end(), second.exclude_samples.begin(),
                                second.exclude_samples.end());
  return result;
}

ImportOptions parse_sidecar(std::string_view json, std::string_view source) {
  const PresetDocument document(json, source);
  const PresetReader root = document.root();
  std::vector<std::string_view> names = {kExclude, kNote};
  for (const ImportOptionRow& row : import_option_table()) names.push_back(row.name);
  root.expect_only(names);
  ImportOptions options;
  for (const ImportOptionRow& row : import_option_table()) {
    if (!root.has(row.name)) continue;
    bool accepted = false;
    if (row.number != nullptr) {
      options.*row.number = root.number(row.name);
      accepted = is_accepted(row, *(options.*row.number));
    } else {
      options.*row.text = root.text(row.name);
      accepted = is_accepted(row, *(options.*row.text));
    }
    if (!accepted) root.fail_value(row.name, row.expectation);
  }
  if (root.has(kExclude)) options.exclude_samples = exclusions(root.object(kExclude));
  return options;
}

ImportOptions load_sidecar(const std::filesystem::path& sidecar) {
  return parse_sidecar(read_csv_file(sidecar, "a sidecar (JSON)"), sidecar.string());
}

ImportOptions with_sidecar(const ImportOptions& options, const std::filesystem::path& file) {
  std::filesystem::path beside = file;
  if (beside.filename().empty()) beside = beside.parent_path();  // "folder/"
  beside += ".sidecar.json";
  if (options.sidecar) return overlaid(options, load_sidecar(*options.sidecar));
  return std::filesystem::exists(beside) ? overlaid(options, load_sidecar(beside)) : options;
}

}  // namespace skyfit::refs
