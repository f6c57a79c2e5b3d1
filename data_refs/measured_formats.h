// SPDX-License-Identifier: Apache-2.0
// The formats of measured skies, recognised by what a file holds, not by its name:
//   CSV of samples        sample_csv.h
//   spectral scan, CSV    spectral_scan_csv.h
//   the same, a folder    spectral_scan_folder.h
//   sky scanner EKO       eko_csv.h
//   145 luminances        patch_csv.h
//   AERONET almucantar    aeronet_csv.h
//   fisheye image         sky_image.h
#pragma once

#include <filesystem>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

// What the sidecar beside the file says is used too, after `options`. Throws std::invalid_argument
// with one line that names file, line, field, value and expectation, std::runtime_error when the
// file cannot be read.
Reference load_measured_sky(const std::filesystem::path& file, const ImportOptions& options);

}  // namespace skyfit::refs
