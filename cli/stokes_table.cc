// SPDX-License-Identifier: Apache-2.0
#include "cli/stokes_table.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace skyfit::cli {

std::string stokes_header(std::string_view place) {
  return fmt::format(
      "{}wavelength_nm,radiance_per_irradiance_sr,q_per_irradiance_sr,u_per_irradiance_sr,"
      "degree_of_linear_polarisation,angle_of_linear_polarisation_deg\n",
      place);
}

void append_stokes(std::string_view place, const StokesValues& stokes,
                   std::span<const WavelengthNode> nodes, int point, PolarisationAngle angle,
                   std::string& out) {
  const double sign = sign_of_u(angle);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    const int wave = static_cast<int>(k);
    const double i = stokes.i.at(point, wave), q = stokes.q.at(point, wave),
                 u = sign * stokes.u.at(point, wave);
    const LinearPolarisation linear = linear_polarisation(i, q, u);
    // Where there is no light or no polarisation, there is no degree or no angle.
    const auto field = [](double value) {
      return std::isnan(value) ? std::string() : fmt::format("{:.9g}", value);
    };
    fmt::format_to(std::back_inserter(out), "{}{:.9g},{:.9g},{:.9g},{:.9g},{},{}\n", place,
                   nodes[k].wavelength_nm, i, q, u, field(linear.degree), field(linear.angle_deg));
  }
}

}  // namespace skyfit::cli
