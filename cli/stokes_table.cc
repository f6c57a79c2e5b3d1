// SPDX-License-Identifier: Apache-2.0
#include "cli/stokes_table.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>

namespace skyfit::cli {

std::vector<SkyColumn> stokes_columns() {
  return {{"radiance_per_irradiance_sr", "sr-1"},
          {"q_per_irradiance_sr", "sr-1"},
          {"u_per_irradiance_sr", "sr-1"},
          {"degree_of_linear_polarisation", "1"},
          {"angle_of_linear_polarisation_deg", "degree"}};
}

std::array<double, kStokesColumns> stokes_row(const StokesValues& stokes, int point, int wavelength,
                                              PolarisationAngle angle) {
  const double i = stokes.i.at(point, wavelength), q = stokes.q.at(point, wavelength),
               u = sign_of_u(angle) * stokes.u.at(point, wavelength);
  const LinearPolarisation linear = linear_polarisation(i, q, u);
  return {i, q, u, linear.degree, linear.angle_deg};
}

std::string stokes_header(std::string_view place) {
  std::string text = fmt::format("{}wavelength_nm", place);
  for (const SkyColumn& column : stokes_columns()) text += fmt::format(",{}", column.name);
  return text + "\n";
}

void append_stokes(std::string_view place, const StokesValues& stokes,
                   std::span<const WavelengthNode> nodes, int point, PolarisationAngle angle,
                   std::string& out) {
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    fmt::format_to(std::back_inserter(out), "{}{:.9g}", place, nodes[k].wavelength_nm);
    for (const double value : stokes_row(stokes, point, static_cast<int>(k), angle))
      out += std::isnan(value) ? std::string(",") : fmt::format(",{:.9g}", value);
    out += '\n';
  }
}

}  // namespace skyfit::cli
