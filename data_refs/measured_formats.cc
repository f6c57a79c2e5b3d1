// SPDX-License-Identifier: Apache-2.0
#include "data_refs/measured_formats.h"

#include <string>

#include "data_refs/csv.h"
#include "data_refs/sample_csv.h"
#include "data_refs/scan_header.h"
#include "data_refs/spectral_scan_csv.h"
#include "data_refs/spectral_scan_folder.h"

namespace skyfit::refs {

Reference load_measured_sky(const std::filesystem::path& file, const ImportOptions& options) {
  validate(options);
  const ImportOptions all = with_sidecar(options, file);
  if (std::filesystem::is_directory(file)) return load_spectral_scan_folder(file, all);
  const std::string text = read_csv_file(file, "a measured sky");
  if (is_spectral_scan(first_line(text))) return parse_spectral_scan(text, file.string(), all);
  return parse_sample_csv(text, file.string());
}

}  // namespace skyfit::refs
