// SPDX-License-Identifier: Apache-2.0
// What `skyfit sky --stokes` leaves: polarised light of every point and wavelength.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "cli/sky_table.h"
#include "model/polarisation.h"
#include "model/sky_model.h"

namespace skyfit::cli {

// I, Q, U, degree and angle of linear polarisation. Where there is no light or no polarisation, the
// degree or the angle is NaN.
constexpr std::size_t kStokesColumns = 5;
std::vector<SkyColumn> stokes_columns();
std::array<double, kStokesColumns> stokes_row(const StokesValues& stokes, int point, int wavelength,
                                              PolarisationAngle angle);

// `place` names the columns of a place, with a comma at its end; so do the fields of
// append_stokes().
std::string stokes_header(std::string_view place);
void append_stokes(std::string_view place, const StokesValues& stokes,
                   std::span<const WavelengthNode> nodes, int point, PolarisationAngle angle,
                   std::string& out);

}  // namespace skyfit::cli
