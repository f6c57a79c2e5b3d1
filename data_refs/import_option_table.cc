// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "data_refs/civil_time.h"
#include "data_refs/csv.h"
#include "data_refs/import_options.h"
#include "data_refs/units.h"

namespace skyfit::refs {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kSmallest = std::numeric_limits<double>::min();

using Options = ImportOptions;
using Rows = std::vector<ImportOptionRow>;

ImportOptionRow number(std::string name, std::optional<double> Options::*member, double lower,
                       double upper, std::string meaning) {
  ImportOptionRow row;
  row.name = std::move(name);
  row.meaning = std::move(meaning);
  row.expectation = upper < kInfinity ? fmt::format("{:g} to {:g}", lower, upper) : "a number > 0";
  row.number = member;
  row.accepts_number = [=](double value) {
    return std::isfinite(value) && value >= lower && value <= upper;
  };
  return row;
}

ImportOptionRow text(std::string name, std::optional<std::string> Options::*member,
                     std::string expectation, std::function<bool(const std::string&)> accepts,
                     std::string meaning) {
  ImportOptionRow row;
  row.name = std::move(name);
  row.meaning = std::move(meaning);
  row.expectation = std::move(expectation);
  row.text = member;
  row.accepts_text = std::move(accepts);
  return row;
}

ImportOptionRow file(std::string name, std::optional<std::string> Options::*member,
                     std::string expectation, std::string meaning) {
  ImportOptionRow row = text(
      std::move(name), member, std::move(expectation),
      [](const std::string& value) { return !value.empty(); }, std::move(meaning));
  row.is_file = true;
  return row;
}

ImportOptionRow choice(std::string name, std::optional<std::string> Options::*member,
                       const std::vector<std::string>& choices, std::string meaning) {
  return text(
      std::move(name), member, fmt::format("{}", fmt::join(choices, " or ")),
      [=](const std::string& value) { return std::ranges::count(choices, value) > 0; },
      std::move(meaning));
}

Rows time_and_place() {
  Rows rows = {
      text(
          "local_time", &Options::local_time, std::string(kTimeForm),
          [](const std::string& value) { return instant(value, 0).has_value(); },
          "Date and time of the scan on the clock of the site"),
      number("utc_offset_h", &Options::utc_offset_h, -kMostUtcOffset_h, kMostUtcOffset_h,
             "Hours that the clock of local_time is ahead of UTC"),
      number("latitude_deg", &Options::latitude_deg, -90, 90, "Latitude of the site, north > 0"),
      number("longitude_deg", &Options::longitude_deg, -180, 360,
             "Longitude of the site, east > 0"),
      number("elevation_m", &Options::elevation_m, -500, 9000,
             "Elevation of the site above the sea"),
      number("sun_zenith_deg", &Options::sun_zenith_deg, 0, 180,
             "Zenith angle of the sun, where time and site are not known"),
      number("sun_azimuth_deg", &Options::sun_azimuth_deg, -360, 360,
             "Azimuth of the sun, clockwise from north")};
  // On the command line a sun is one of analytic references.
  for (ImportOptionRow& row : rows) row.on_command_line = !row.name.starts_with("sun_");
  return rows;
}

Rows samples() {
  return {text(
              "unit", &Options::unit, "one of " + unit_names(),
              [](const std::string& value) { return find_unit(value).has_value(); },
              "Unit of the values"),
          number("saturation", &Options::saturation, kSmallest, kInfinity,
                 "Values from this one on, in the unit of the file, are not used"),
          number("near_sun_deg", &Options::near_sun_deg, 0, 180,
                 "Samples closer to the sun are not used")};
}

Rows azimuths() {
  return {choice("azimuth_zero", &Options::azimuth_zero, {"north", "south"},
                 "Direction of azimuth 0 in the file"),
          choice("azimuth_turns", &Options::azimuth_turns, {"clockwise", "counter-clockwise"},
                 "Sense of the azimuths, seen from above")};
}

Rows patches() {
  return {choice("patch_order", &Options::patch_order, {"boustrophedon", "rows"},
                 "Order of a scan of 145 patches: rows in alternating or in one direction")};
}

Rows bands() {
  return {number("band_nm", &Options::band_nm, 1, 100,
                 "Width of the bands over which a folder of spectra is averaged, by default 5")};
}

Rows instruments() {
  return {file("instrument_parameters", &Options::instrument_parameters,
               "an ins.para of SKYRAD.pack",
               "Calibration of a sky radiometer; a sidecar names it from its own folder")};
}

Rows images() {
  constexpr double kMostPixels = 1e6;
  return {
      choice("projection", &Options::projection,
             {"equidistant", "equisolid", "orthographic", "stereographic", "polynomial",
              "equirectangular", "angular", "cube", "octahedral"},
             "Projection of a fisheye image, of a panorama (equirectangular) or of a map of all "
             "directions as sky-map writes it"),
      text(
          "lens_polynomial", &Options::lens_polynomial, "C1,C2,..",
          [](const std::string& value) { return !number_list(value).empty(); },
          "Radius over radius_px = C1 s + C2 s^2 + .., s the zenith angle over 90 deg"),
      number("centre_x_px", &Options::centre_x_px, -kMostPixels, kMostPixels,
             "Zenith in an image, from the left edge; by default the middle"),
      number(
          "centre_y_px", &Options::centre_y_px, -kMostPixels, kMostPixels,
          "Zenith in an image, or the horizon in a panorama, from the upper edge; by default the "
          "middle"),
      number("radius_px", &Options::radius_px, 1, kMostPixels,
             "Radius of the horizon; by default half the shorter side"),
      number(
          "north_deg", &Options::north_deg, -360, 360,
          "Direction of north in the image, clockwise from its upper edge; in a panorama right of "
          "its middle, in a map right of the map's own north; by default 0"),
      choice("east", &Options::east, {"left", "right"},
             "Side of east where north is up; by default left in a fisheye image, right in a "
             "panorama or a map"),
      number("lumen_per_watt", &Options::lumen_per_watt, kSmallest, kInfinity,
             "Luminance per radiance (179 or 683) of pixels in W m-2 sr-1; replaces the unit"),
      number("calibration", &Options::calibration, kSmallest, kInfinity,
             "Factor on the pixels of an image"),
      choice("primaries", &Options::primaries, {"srgb", "radiance"},
             "Primaries of the pixels, by default srgb in EXR and radiance in HDR"),
      file("mask", &Options::mask, "an image of the same size",
           "Pixels that are dark in this image are not used; a sidecar names it from its own "
           "folder"),
      number("bin_deg", &Options::bin_deg, 1, 30,
             "Height of the bins over which pixels are averaged, by default 6; 12 gives the "
             "145 patches")};
}

Rows make_table() {
  Rows table;
  const auto add = [&](unsigned formats, Rows rows) {
    for (ImportOptionRow& row : rows) {
      row.formats = formats;
      table.push_back(std::move(row));
    }
  };
  add(kScans, time_and_place());
  add(kScans, samples());
  add(kSpectralScan | kSpectralFolder | kPatchScan, azimuths());
  add(kPatchScan, patches());
  add(kSpectralFolder, bands());
  add(kSkyRadiometer, instruments());
  add(kSkyImage, images());
  return table;
}

}  // namespace

std::span<const ImportOptionRow> import_option_table() {
  static const Rows table = make_table();
  return table;
}

bool ImportOptionRow::is_set(const ImportOptions& options) const {
  return number != nullptr ? (options.*number).has_value() : (options.*text).has_value();
}

bool ImportOptionRow::set(std::string_view value, ImportOptions& options) const {
  if (text != nullptr) {
    options.*text = value;
    return accepts_text(*(options.*text));
  }
  options.*number = csv_number(value);
  return options.*number && accepts_number(*(options.*number));
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

}  // namespace skyfit::refs
