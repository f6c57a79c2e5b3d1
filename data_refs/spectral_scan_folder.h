// SPDX-License-Identifier: Apache-2.0
// A spectral scan as a folder with one file per direction, as the spectrometer of Kider et al. 2014
// left it: DATE___HH.MM.SS_-_INDEX____AZIMUTH___ALTITUDE.asd.rad.txt, in it one header line, then
// `nm<TAB>radiance`, wavelengths ascending. The name holds local time, the number of the direction,
// and degrees; azimuth runs counter-clockwise from north unless the facts say otherwise. The unit
// of the layout is W m-2 sr-1 nm-1. Site and offset from UTC come from the options or the sidecar.
// Radiances are averaged over bands (ImportOptions::band_nm) centred on its multiples; 5 nm, where
// nothing else is said, are the bands of the solar irradiance that the model is multiplied with.
#pragma once

#include <filesystem>

#include "data_refs/import_options.h"
#include "data_refs/samples.h"

namespace skyfit::refs {

// Throws std::invalid_argument `folder/file:line: field = value: expected ...`; std::runtime_error
// when a file cannot be read.
Reference load_spectral_scan_folder(const std::filesystem::path& folder,
                                    const ImportOptions& options);

}  // namespace skyfit::refs
