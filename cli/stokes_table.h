// SPDX-License-Identifier: Apache-2.0
// The CSV of `skyfit sky --stokes`: polarised light of every point and wavelength.
#pragma once

#include <string>
#include <string_view>

#include "model/polarisation.h"
#include "model/sky_model.h"

namespace skyfit::cli {

// `place` names the columns of a place, with a comma at its end; so do the fields of
// append_stokes().
std::string stokes_header(std::string_view place);
void append_stokes(std::string_view place, const StokesValues& stokes,
                   std::span<const WavelengthNode> nodes, int point, PolarisationAngle angle,
                   std::string& out);

}  // namespace skyfit::cli
