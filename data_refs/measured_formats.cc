// SPDX-License-Identifier: Apache-2.0
#include "data_refs/measured_formats.h"

#include <stdexcept>
#include <string>

#include "data_refs/aeronet_csv.h"
#include "data_refs/csv.h"
#include "data_refs/eko_csv.h"
#include "data_refs/patch_csv.h"
#include "data_refs/sample_csv.h"
#include "data_refs/scan_header.h"
#include "data_refs/sky_image.h"
#include "data_refs/spectral_scan_csv.h"
#include "data_refs/spectral_scan_folder.h"

namespace skyfit::refs {

Reference load_measured_sky(const std::filesystem::path& file, const ImportOptions& options) {
  validate(options);
  const ImportOptions all = with_sidecar(options, file);
  if (std::filesystem::is_directory(file)) return load_spectral_scan_folder(file, all);
  if (is_sky_image(file)) return load_sky_image(file, all);
  const std::string text = read_csv_file(file, "a measured sky");
  const std::string name = file.string();
  if (text.find('\0') != text.npos) {
    throw std::invalid_argument(
        name + ": no measured sky: expected text, or an image in OpenEXR or Radiance HDR");
  }
  const std::string_view line = first_line(text);
  if (is_eko_csv(line)) return parse_eko_csv(text, name, all);
  if (is_aeronet_csv(text)) return parse_aeronet_csv(text, name, all);
  if (is_spectral_scan(line)) return parse_spectral_scan(text, name, all);
  if (is_patch_csv(line)) return parse_patch_csv(text, name, all);
  return parse_sample_csv(text, name);
}

}  // namespace skyfit::refs
