// SPDX-License-Identifier: Apache-2.0
// The CSV of `skyfit sky --stokes`: polarised light of every point and wavelength.
#pragma once

#include <string>
#include <string_view>

#include "model/sky_model.h"

namespace skyfit::cli {

// In which sense U and the angle of polarisation are counted, as the observer sees them: clockwise
// from up, or counter-clockwise as the International Astronomical Union counts.
enum class PolarisationAngle { kClockwise, kIau };

// Degree of linear polarisation, 0 .. 1, and its angle from the meridian plane in degrees, above
// -90 to 90; NaN without light, and the angle without polarisation.
struct LinearPolarisation {
  double degree, angle_deg;
};
LinearPolarisation linear_polarisation(double i, double q, double u);

// `place` names the columns of a place, with a comma at its end; so do the fields of
// append_stokes().
std::string stokes_header(std::string_view place);
void append_stokes(std::string_view place, const StokesValues& stokes,
                   std::span<const WavelengthNode> nodes, int point, PolarisationAngle angle,
                   std::string& out);

}  // namespace skyfit::cli
