// SPDX-License-Identifier: Apache-2.0
// What a file of a measured sky may leave open: where and when it was measured, in which unit, how
// its azimuths run, which samples are not to be used. One table names every such fact; it is read
// from the head of the file (`# name=value name=value`), from a sidecar file and from the command
// line, and each overrules the ones before it.
//
// The sidecar of sky.csv is sky.csv.sidecar.json (of a folder: folder.sidecar.json): a JSON object
// with the names of the table, "exclude_samples": {"0": "why sample 0 is not used"}, and "note" for
// the reader.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "data_refs/column_mapping.h"
#include "model/base/input_file.h"

namespace skyfit::refs {

struct ExcludedSample {
  int sample;  // its number in the file, or from 0 in the order of the file
  std::string reason;
};

struct ImportOptions {
  std::optional<std::string> unit, local_time, azimuth_zero, azimuth_turns, patch_order;
  std::optional<double> utc_offset_h, latitude_deg, longitude_deg, elevation_m;
  std::optional<double> sun_zenith_deg, sun_azimuth_deg;
  std::optional<double> saturation, near_sun_deg, band_nm;
  std::optional<std::string> instrument_parameters;  // a file (pom_instrument.h)
  // Of images (sky_image.h).
  std::optional<std::string> projection, lens_polynomial, east, primaries, mask;
  std::optional<double> centre_x_px, centre_y_px, radius_px, north_deg;
  std::optional<double> lumen_per_watt, calibration, bin_deg;
  std::optional<ColumnMapping> columns;  // of a text file with columns of its own, by a sidecar
  std::vector<ExcludedSample> exclude_samples;
  bool accept_sun = false;                       // though the light puts it elsewhere (sun_check.h)
  std::optional<std::filesystem::path> sidecar;  // in the place of the one beside the file
  NamedFiles named_files = NamedFiles::kInItsFolder;  // which a sidecar may name
};

// The kinds of measured skies that a fact can be about, as bits.
enum SkyFormats : unsigned {
  kSampleCsv = 1,
  kSpectralScan = 2,
  kSpectralFolder = 4,
  kPatchScan = 8,
  kAlmucantar = 16,
  kSkyImage = 32,
  kSkyRadiometer = 64,
  kScans = kSpectralScan | kSpectralFolder | kPatchScan | kAlmucantar | kSkyImage | kSkyRadiometer
};

// A row holds either a number or a text.
struct ImportOptionRow {
  std::string name;         // "latitude_deg"; --latitude-deg on the command line
  std::string expectation;  // "-90 to 90"
  std::string meaning;
  std::optional<double> ImportOptions::*number = nullptr;
  std::function<bool(double)> accepts_number;
  std::optional<std::string> ImportOptions::*text = nullptr;
  std::function<bool(const std::string&)> accepts_text;
  unsigned formats = kScans;  // that it is about
  bool on_command_line = true;
  bool is_file = false;  // which a sidecar names from its own folder

  bool is_set(const ImportOptions& options) const;
  // Sets what the text says; false when it is not what the row expects.
  bool set(std::string_view value, ImportOptions& options) const;
};

std::span<const ImportOptionRow> import_option_table();

// "a,b,c"; empty when a part is no finite number.
std::vector<double> number_list(std::string_view text);

// Throws std::invalid_argument `latitude_deg = 95: must be -90 to 90`.
void validate(const ImportOptions& options);

// `first` where it says something, `second` elsewhere. Exclusions are joined.
ImportOptions overlaid(const ImportOptions& first, const ImportOptions& second);

// Throws std::invalid_argument `source:line: name = value: expected ...`.
ImportOptions parse_sidecar(std::string_view json, std::string_view source);

// The same of a file, with the paths of the files that it names. Throws std::runtime_error when it
// cannot be read.
ImportOptions load_sidecar(const std::filesystem::path& sidecar, NamedFiles named);

// What `options` and the sidecar of `file`, if there is one, say. Throws std::runtime_error when a
// sidecar that was named cannot be read.
ImportOptions with_sidecar(const ImportOptions& options, const std::filesystem::path& file);

}  // namespace skyfit::refs
