// SPDX-License-Identifier: Apache-2.0
// Tabulated shapes of the ground's albedo: data_refs/ground_spectra.csv, with its provenance.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "model/atmosphere/ground_spectrum.h"

namespace skyfit::refs {

std::vector<std::string> ground_names();  // "flat", "grass", "sand", "snow"

// A name, or the path of a CSV with the columns wavelength_nm and relative_albedo; null for "flat".
// Throws std::invalid_argument that lists the names, or names file, line and value.
std::shared_ptr<const GroundSpectrum> ground_spectrum(std::string_view name);

}  // namespace skyfit::refs
