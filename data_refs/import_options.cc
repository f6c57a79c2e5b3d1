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
using Accepts = bool (*)(const std::string&);

ImportOptionRow number_row(std::string_view name, std::optional<double> Options::*member,
                           double lower, double upper, std::string_view expectation,
                           std::string_view meaning) {
  ImportOptionRow row{name, expectation, meaning};
  row.number = member;
  row.lower = lower;
  row.upper = upper;
  return row;
}

ImportOptionRow text_row(std::string_view name, std::optional<std::string> Options::*member,
                         std::string_view expectation, std::string_view meaning, Accepts accepts) {
  ImportOptionRow row{name, expectation, meaning};
  row.text = member;
  row.accepts = accepts;
  return row;
}

void add_time_and_place(std::vector<ImportOptionRow>& table) {
  table.insert(table.end(),
               {text_row("local_time", &Options::local_time, "YYYY-MM-DDTHH:MM:SS",
                         "Date and time of the scan on the clock of the site",
                         [](const std::string& text) { return instant(text, 0).has_value(); }),
                number_row("utc_offset_h", &Options::utc_offset_h, -14, 14, "-14 to 14",
                           "Hours that this clock is ahead of UTC"),
                number_row("latitude_deg", &Options::latitude_deg, -90, 90, "-90 to 90",
                           "Of the site, north > 0"),
                number_row("longitude_deg", &Options::longitude_deg, -180, 360, "-180 to 360",
                           "Of the site, east > 0"),
                number_row("elevation_m", &Options::elevation_m, -500, 9000, "-500 to 9000",
                           "Of the site above the sea")});
  table.push_back(number_row("sun_zenith_deg", &Options::sun_zenith_deg, 0, 180, "0 to 180",
                             "Of the sun, where time and site are not known"));
  table.back().on_command_line = false;  // there it is a fact of analytic references
  table.push_back(number_row("sun_azimuth_deg", &Options::sun_azimuth_deg, -360, 360, "-360 to 360",
                             "Of the sun, clockwise from north"));
  table.back().on_command_line = false;
}

void add_samples(std::vector<ImportOptionRow>& table) {
  static const std::string unit_list = "one of " + unit_names();
  table.insert(
      table.end(),
      {text_row("unit", &Options::unit, unit_list, "Unit of the values",
                [](const std::string& text) { return find_unit(text).has_value(); }),
       text_row("azimuth_zero", &Options::azimuth_zero, "north or south",
                "Where the azimuths of the file start",
                [](const std::string& text) { return text == "north" || text == "south"; }),
       text_row("azimuth_turns", &Options::azimuth_turns, "clockwise or counter-clockwise",
                "Seen from above",
                [](const std::string& text) {
                  return text == "clockwise" || text == "counter-clockwise";
                }),
       text_row("patch_order", &Options::patch_order, "boustrophedon or rows",
                "Of a scan of 145 patches: to and fro, or every row from azimuth zero on",
                [](const std::string& text) { return text == "boustrophedon" || text == "rows"; }),
       number_row("saturation", &Options::saturation, kSmallest, kInfinity, "a number > 0",
                  "Values from here on, in the unit of the file, are not used"),
       number_row("near_sun_deg", &Options::near_sun_deg, 0, 180, "0 to 180",
                  "Samples closer to the sun are not used"),
       number_row("band_nm", &Options::band_nm, 1, 100, "1 to 100",
                  "Width of the bands over which a folder of spectra is averaged, else 5")});
}

void add_lens(std::vector<ImportOptionRow>& table) {
  table.insert(
      table.end(),
      {text_row("projection", &Options::projection,
                "equidistant, equisolid, orthographic or polynomial", "Of a fisheye image",
                [](const std::string& text) {
                  return text == "equidistant" || text == "equisolid" || text == "orthographic" ||
                         text == "polynomial";
                }),
       text_row("lens_polynomial", &Options::lens_polynomial, "C1,C2,..",
                "radius/radius_px = C1 t + C2 t^2 + .., t the zenith angle over 90 deg",
                [](const std::string& text) { return !number_list(text).empty(); }),
       number_row("centre_x_px", &Options::centre_x_px, -1e6, 1e6, "a number of pixels",
                  "Of the zenith from the left edge, else the middle"),
       number_row("centre_y_px", &Options::centre_y_px, -1e6, 1e6, "a number of pixels",
                  "Of the zenith from the upper edge, else the middle"),
       number_row("radius_px", &Options::radius_px, 1, 1e6, "a number >= 1",
                  "Of the horizon, else half the shorter side"),
       number_row("north_deg", &Options::north_deg, -360, 360, "-360 to 360",
                  "Where north lies in the image, clockwise from its upper edge, else 0"),
       text_row("east", &Options::east, "left or right",
                "Of north in the image; left, as one looks up, unless it was flipped",
                [](const std::string& text) { return text == "left" || text == "right"; })});
}

void add_pixels(std::vector<ImportOptionRow>& table) {
  table.insert(
      table.end(),
      {number_row("lumen_per_watt", &Options::lumen_per_watt, kSmallest, 1e4,
                  "179, 683 or another "
                  "number > 0",
                  "Makes luminances of pixels that are radiances, W m-2 sr-1"),
       number_row("calibration", &Options::calibration, kSmallest, kInfinity, "a number > 0",
                  "Factor on the pixels of an image"),
       text_row("primaries", &Options::primaries, "srgb or radiance",
                "Of the pixels' red, green and blue, else srgb in EXR and radiance in HDR",
                [](const std::string& text) { return text == "srgb" || text == "radiance"; }),
       text_row("mask", &Options::mask, "an image of the same size",
                "Whose dark pixels are not used; a sidecar names it from its own folder",
                [](const std::string& text) { return !text.empty(); }),
       number_row(
           "bin_deg", &Options::bin_deg, 1, 30, "1 to 30",
           "Height of the bins over which pixels are averaged, else 6; 12: the 145 patches")});
}

std::vector<ImportOptionRow> make_table() {
  std::vector<ImportOptionRow> table;
  add_time_and_place(table);
  add_samples(table);
  add_lens(table);
  add_pixels(table);
  return table;
}

bool is_accepted(const ImportOptionRow& row, double value) {
  return std::isfinite(value) && value >= row.lower && value <= row.upper;
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

std::vector<double> number_list(std::string_view text) {
  std::vector<double> numbers;
  for (const std::string& field : csv_fields(text, {}, 0)) {
    const std::optional<double> number = csv_number(field);
    if (!number || !std::isfinite(*number)) return {};
    numbers.push_back(*number);
  }
  return numbers;
}

bool set_import_option(const ImportOptionRow& row, std::string_view text, ImportOptions& options) {
  if (row.text != nullptr) {
    options.*row.text = text;
    return row.accepts(*(options.*row.text));
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
    if (row.text != nullptr && options.*row.text && !row.accepts(*(options.*row.text)))
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
      accepted = row.accepts(*(options.*row.text));
    }
    if (!accepted) root.fail_value(row.name, row.expectation);
  }
  if (root.has(kExclude)) options.exclude_samples = exclusions(root.object(kExclude));
  return options;
}

ImportOptions load_sidecar(const std::filesystem::path& sidecar) {
  ImportOptions options =
      parse_sidecar(read_csv_file(sidecar, "a sidecar (JSON)"), sidecar.string());
  if (options.mask) options.mask = (sidecar.parent_path() / *options.mask).string();
  return options;
}

ImportOptions with_sidecar(const ImportOptions& options, const std::filesystem::path& file) {
  std::filesystem::path beside = file;
  if (beside.filename().empty()) beside = beside.parent_path();  // "folder/"
  beside += ".sidecar.json";
  if (options.sidecar) return overlaid(options, load_sidecar(*options.sidecar));
  return std::filesystem::exists(beside) ? overlaid(options, load_sidecar(beside)) : options;
}

}  // namespace skyfit::refs
