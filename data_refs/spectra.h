// SPDX-License-Identifier: Apache-2.0
// The standard tabulated inputs: CIE 1931 colour matching functions, ASTM E490 solar spectrum,
// cross sections of ozone, nitrogen dioxide and pairs of oxygen molecules (provenance in the CSV
// files beside this header, which are compiled in).
#pragma once

#include "model/atmosphere/atmosphere.h"
#include "model/photometry/photometry.h"

namespace skyfit::refs {

const SpectralData& standard_spectral_data();

// The same under the star of an atmosphere.
SpectralData spectral_data_of(const Atmosphere<double>& atmosphere);

}  // namespace skyfit::refs
