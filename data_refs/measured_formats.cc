// SPDX-License-Identifier: Apache-2.0
#include "data_refs/measured_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "data_refs/absorption_bands.h"
#include "data_refs/aeronet_csv.h"
#include "data_refs/aeronet_polarised.h"
#include "data_refs/arm_csphot.h"
#include "data_refs/civil_time.h"
#include "data_refs/csv.h"
#include "data_refs/eko_csv.h"
#include "data_refs/mapped_sky.h"
#include "data_refs/measured_sky.h"
#include "data_refs/other_formats.h"
#include "data_refs/patch_csv.h"
#include "data_refs/sample_csv.h"
#include "data_refs/sample_csv_columns.h"
#include "data_refs/scan_header.h"
#include "data_refs/sky_image.h"
#include "data_refs/sky_radiometer.h"
#include "data_refs/spectral_scan_csv.h"
#include "data_refs/spectral_scan_folder.h"
#include "data_refs/sun_check.h"
#include "model/base/input_file.h"
#include "model/numerics/angles.h"

namespace skyfit::refs {
namespace {

// Facts that sun_of_scan() takes.
bool is_about_sun(const ImportOptionRow& row) {
  constexpr std::array kAbout = {"local_time",  "utc_offset_h",   "latitude_deg",   "longitude_deg",
                                 "elevation_m", "sun_zenith_deg", "sun_azimuth_deg"};
  return std::ranges::find(kAbout, row.name) != kAbout.end();
}

// A CSV of samples has columns for its facts: what its comments state would change its values, or
// is not needed.
void check_comments(const SkyFile& file, std::vector<std::string>& notes) {
  const ScanHeader header = scan_header(file.text(), file.name());
  for (const ImportOptionRow& row : import_option_table()) {
    if (!row.is_set(header.facts)) continue;
    const std::string what = header.place(file.name(), row.name) + ": " + row.name;
    if (!is_about_sun(row))
      throw std::invalid_argument(
          what +
          ": expected none in a CSV of samples, whose columns say unit, direction and weight");
    notes.push_back(what + " is not used: a CSV of samples has columns of suns and times");
  }
}

// The columns of samples say their unit; another one stated beside them contradicts them.
void check_unit(std::string_view source, std::string_view stated, const Reference& samples) {
  const std::optional<Unit> unit = find_unit(stated);
  const bool agrees = unit && unit->quantity == samples.quantity &&
                      (unit->factor == 1 || samples.quantity == Quantity::kRelativeLuminance);
  if (agrees) return;
  throw std::invalid_argument(
      fmt::format("{}: unit = {}: expected none, the columns say that it is {}", source, stated,
                  quantity_name(samples.quantity)));
}

Reference read_samples(const SkyFile& file, const ImportOptions& facts) {
  constexpr auto kNone = std::string_view::npos;
  const std::string_view line = file.line();
  // Columns that samples have.
  if (line.find("view_zenith_deg") == kNone || line.find(',') == kNone) {
    if (const auto other = other_format(file.text()))
      throw std::invalid_argument(file.name() + ": " + *other);
  }
  if (const std::string_view other = other_delimiter(line); !other.empty())
    throw std::invalid_argument(fmt::format(
        "{}: columns between {}: expected commas, or a sidecar with \"delimiter\" and \"columns\"",
        file.name(), other));
  std::vector<std::string> notes;
  check_comments(file, notes);
  Reference sky = parse_sample_csv(file.text(), file.name(), facts.exclude_samples);
  std::ranges::move(notes, std::back_inserter(sky.notes));
  return sky;
}

template <Reference parse(std::string_view, std::string_view, const ImportOptions&)>
Reference read_text(const SkyFile& file, const ImportOptions& facts) {
  return parse(file.text(), file.name(), facts);
}

constexpr std::array<MeasuredFormat, 10> kFormats = {{
    {kSpectralFolder, "folder of spectra",
     "DATE___HH.MM.SS_-_INDEX____AZIMUTH___ALTITUDE.asd.rad.txt, one a direction; averaged over 5 "
     "nm",
     "Kider et al. 2014, their published measurements", "spectral_scan_folder",
     [](const SkyFile& file) { return file.is_folder(); },
     [](const SkyFile& file, const ImportOptions& facts) {
       return load_spectral_scan_folder(file.path(), facts);
     }},
    {kSkyImage, "image",
     "OpenEXR or Radiance HDR, fisheye, panorama or map of all directions; averaged over bins of 6 "
     "deg",
     "OpenEXR and Radiance, through OpenImageIO; Radiance manual, file formats", "fisheye.exr",
     [](const SkyFile& file) { return is_sky_image(file.path()); },
     [](const SkyFile& file, const ImportOptions& facts) {
       return load_sky_image(file.path(), facts);
     }},
    {kAlmucantar, "ARM csphotalm", "NetCDF of almucantars of sky radiance",
     "ARM, header of tmpcsphotalmM1.a1", "arm_csphotalm.nc",
     [](const SkyFile& file) { return is_netcdf(file.path()); },
     [](const SkyFile& file, const ImportOptions& facts) {
       return load_arm_csphot(file.path(), facts);
     }},
    {kSkyRadiometer, "SKYNET",
     "the file .dat of a sky radiometer POM-01 or POM-02, with its calibration in an ins.para",
     "PREDE, manual of the POM-02, data format; skyrad.pack 5.0", "sky_radiometer.dat",
     [](const SkyFile& file) { return is_sky_radiometer(file.line()); },
     read_text<parse_sky_radiometer>},
    {kPatchScan, "EKO MS-321LR", "the scanner's CSV of 145 patches; its luminances are read",
     "EKO, instruction manual of the MS-321LR, section 7-4", "sky_scan_eko.csv",
     [](const SkyFile& file) { return is_eko_csv(file.line()); }, read_text<parse_eko_csv>},
    {kAlmucantar, "AERONET polarised",
     "almucantars of radiance and degree of polarisation (ALP, version 3)",
     "public code that reads it (DataCrossing)", "aeronet_polarised.csv",
     [](const SkyFile& file) { return is_aeronet_polarised(file.text()); },
     read_text<parse_aeronet_polarised>},
    {kAlmucantar, "AERONET", "almucantars and principal planes of sky radiance, versions 2 and 3",
     "AERONET, data descriptions and files of its web service", "aeronet_almucantar.csv",
     [](const SkyFile& file) { return is_aeronet_csv(file.text()); }, read_text<parse_aeronet_csv>},
    {kSpectralScan, "spectral scan",
     "CSV with sample, view_azimuth_deg, view_zenith_deg, radiance_380, ..", "of this project",
     "spectral_scan.csv", [](const SkyFile& file) { return is_spectral_scan(file.line()); },
     read_text<parse_spectral_scan>},
    {kPatchScan, "145 values", "nothing but the luminances of the patches, in the scanner's order",
     "Tregenza 1987, the numbering of the patches", "sky_scan_145.csv",
     [](const SkyFile& file) { return is_patch_csv(file.line()); }, read_text<parse_patch_csv>},
    {kSampleCsv, "CSV of samples",
     "any directions; luminance, relative luminance or spectral radiance, and polarisation",
     "of this project", "clear_sky_two_suns.csv", [](const SkyFile&) { return true; },
     read_samples},
}};

const MeasuredFormat& format_of(const SkyFile& file) {
  return *std::ranges::find_if(kFormats, [&](const MeasuredFormat& f) { return f.matches(file); });
}

}  // namespace

SkyFile::SkyFile(std::filesystem::path path)
    : path_(std::move(path)), is_folder_(std::filesystem::is_directory(path_)) {
  if (!is_folder_) require_regular_file(path_, "a measured sky", kMostImageBytes);
}

const std::string& SkyFile::text() const {
  if (!text_) {
    text_ = read_text_file(path_, "a measured sky");
    if (text_->find('\0') != std::string::npos) {
      if (const auto other = other_format(*text_))
        throw std::invalid_argument(name() + ": " + *other);
      throw std::invalid_argument(
          name() + ": no measured sky: expected text, or an image in OpenEXR or Radiance HDR");
    }
  }
  return *text_;
}

std::string_view SkyFile::line() const { return first_line(text()); }

std::span<const MeasuredFormat> measured_formats() { return kFormats; }

Reference load_measured_sky(const std::filesystem::path& path, const ImportOptions& options) {
  validate(options);
  const ImportOptions facts = with_sidecar(options, path);
  SkyFile file(path);
  MappedSky mapped;
  if (facts.columns) {
    mapped = mapped_sky(file.text(), file.name(), facts);
    file.set_text(std::move(mapped.text));
  }
  const MeasuredFormat& format = format_of(file);
  Reference sky = format.read(file, facts);
  if (facts.columns) {
    if (mapped.site) {
      for (Scan& scan : sky.scans) scan.site = mapped.site;
    }
    std::ranges::move(mapped.notes, std::back_inserter(sky.notes));
    std::ranges::move(check_mapped_suns(sky, file.name(), facts), std::back_inserter(sky.notes));
  }
  mask_unknown_wavelengths(sky);
  check_suns(facts, sky);
  for (const ImportOptionRow& row : import_option_table()) {
    const bool is_used =
        (row.formats & format.format) != 0 || (mapped.facts_are_used && is_about_sun(row));
    if (!row.is_set(facts) || is_used) continue;
    // It would change values and directions, were they a spectral scan's.
    if (facts.columns && format.format == kSampleCsv && !is_about_sun(row) &&
        (row.formats & kSpectralScan) != 0)
      throw std::invalid_argument(fmt::format(
          "{}: {}: expected none beside columns of luminance; \"times\" and \"plus\" of a column "
          "change its values",
          file.name(), row.name));
    if (format.format == kSampleCsv && row.name == "unit")
      check_unit(file.name(), *facts.unit, sky);
    sky.notes.push_back(row.name + " is not used: it is not about this format");
  }
  return sky;
}

}  // namespace skyfit::refs
