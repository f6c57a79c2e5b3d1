// SPDX-License-Identifier: Apache-2.0
#include "cli/stokes_table.h"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <limits>

#include "model/numerics/angles.h"

namespace skyfit::cli {

// docs/theory (13.15).
LinearPolarisation linear_polarisation(double i, double q, double u) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), polarised = std::hypot(q, u);
  if (!(i > 0)) return {nan, nan};
  if (!(polarised > 0)) return {0, nan};
  const double angle = 0.5 * std::atan2(u, q) * kDegreesPerRadian;
  return {polarised / i, angle <= -90 ? 90 : angle};
}

std::string stokes_header(std::string_view place) {
  return fmt::format(
      "{}wavelength_nm,radiance_per_irradiance_sr,q_per_irradiance_sr,u_per_irradiance_sr,"
      "degree_of_linear_polarisation,angle_of_linear_polarisation_deg\n",
      place);
}

void append_stokes(std::string_view place, const StokesValues& stokes,
                   std::span<const WavelengthNode> nodes, int point, PolarisationAngle angle,
                   std::string& out) {
  const double sign = angle == PolarisationAngle::kIau ? -1 : 1;
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
