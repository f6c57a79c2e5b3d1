// SPDX-License-Identifier: Apache-2.0
#include "data_refs/measured_formats.h"

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "data_refs/absorption_bands.h"
#include "data_refs/aeronet_csv.h"
#include "data_refs/csv.h"
#include "data_refs/eko_csv.h"
#include "data_refs/other_formats.h"
#include "data_refs/patch_csv.h"
#include "data_refs/sample_csv.h"
#include "data_refs/scan_header.h"
#include "data_refs/sky_image.h"
#include "data_refs/spectral_scan_csv.h"
#include "data_refs/spectral_scan_folder.h"
#include "model/base/input_file.h"

namespace skyfit::refs {
namespace {

struct LoadedSky {
  Reference sky;
  SkyFormats format;
};

LoadedSky load_text(const std::string& text, const std::string& name, const ImportOptions& facts) {
  if (text.find('\0') != text.npos) {
    throw std::invalid_argument(
        name + ": no measured sky: expected text, or an image in OpenEXR or Radiance HDR");
  }
  const std::string_view line = first_line(text);
  if (is_eko_csv(line)) return {parse_eko_csv(text, name, facts), kPatchScan};
  if (is_aeronet_csv(text)) return {parse_aeronet_csv(text, name, facts), kAlmucantar};
  if (is_spectral_scan(line)) return {parse_spectral_scan(text, name, facts), kSpectralScan};
  if (is_patch_csv(line)) return {parse_patch_csv(text, name, facts), kPatchScan};
  if (line.find("_zenith_deg") == line.npos) {  // which a CSV of samples has
    if (const auto other = other_format(text)) throw std::invalid_argument(name + ": " + *other);
  }
  return {parse_sample_csv(text, name, facts.exclude_samples), kSampleCsv};
}

LoadedSky load(const std::filesystem::path& file, const ImportOptions& facts) {
  if (std::filesystem::is_directory(file))
    return {load_spectral_scan_folder(file, facts), kSpectralFolder};
  require_regular_file(file, "a measured sky", kMostImageBytes);
  if (is_sky_image(file)) return {load_sky_image(file, facts), kSkyImage};
  return load_text(read_csv_file(file, "a measured sky"), file.string(), facts);
}

}  // namespace

Reference load_measured_sky(const std::filesystem::path& file, const ImportOptions& options) {
  validate(options);
  const ImportOptions facts = with_sidecar(options, file);
  LoadedSky loaded = load(file, facts);
  mask_unknown_wavelengths(loaded.sky);
  for (const ImportOptionRow& row : import_option_table()) {
    if (row.is_set(facts) && (row.formats & loaded.format) == 0)
      loaded.sky.notes.push_back(row.name + " is not used: it is not about this format");
  }
  return std::move(loaded.sky);
}

}  // namespace skyfit::refs
